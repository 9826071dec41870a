#pragma once
#include <atomic>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/error.hpp"
#include "session/running_replay.hpp"
#include "support/fake_session.hpp"

namespace ream::test {

/// A replay of ten seconds without a recording; its clock stands still.
class FakeReplay final : public session::RunningReplay {
 public:
  explicit FakeReplay(session::ReplayRequest request) : request_(std::move(request)) {
    status_.duration_s = 10.0;
    status_.force_scale = 26.0;
    status_.unwatched_s = 1.0;
    status_.warning = "recording.ream ends inside a chunk";
    ++alive();
  }
  ~FakeReplay() override { --alive(); }

  session::PlaybackStatus status() const override {
    const std::lock_guard lock(mutex_);
    return status_;
  }
  std::vector<session::ReplayMark> marks() const override { return {{2.5, "annotation", "too steep here"}}; }
  nlohmann::json metrics() const override {
    {
      const std::lock_guard lock(mutex_);
      if (metrics_problem_) throw Error(*metrics_problem_, "no metrics of this moment");
    }
    return FakeSession({request_.id, "demo", "demo", 26.0}).metrics();
  }
  void change(const session::PlaybackChange& change) override {
    const std::lock_guard lock(mutex_);
    if (change.position_s && *change.position_s > status_.duration_s)
      throw Error(ErrorKind::invalid_input, "position_s is past the end");
    if (change.position_s) status_.position_s = *change.position_s;
    if (change.playing) status_.playing = *change.playing;
    if (change.speed) status_.speed = *change.speed;
  }
  void stop() override { ++stops(); }
  std::unique_ptr<net::WebSocketSession> subscribe(int) override {
    return std::make_unique<FakeViewer>(request_.id);
  }

  void set_unwatched_s(double seconds) {
    const std::lock_guard lock(mutex_);
    status_.unwatched_s = seconds;
  }
  /// Metrics are refused so.
  void refuse_metrics(ErrorKind kind) {
    const std::lock_guard lock(mutex_);
    metrics_problem_ = kind;
  }
  static std::atomic<int>& alive() {
    static std::atomic<int> count{0};
    return count;
  }
  static std::atomic<int>& stops() {
    static std::atomic<int> count{0};
    return count;
  }

 private:
  const session::ReplayRequest request_;
  mutable std::mutex mutex_;
  session::PlaybackStatus status_;
  std::optional<ErrorKind> metrics_problem_;
};

}  // namespace ream::test
