#pragma once
#include <atomic>
#include <chrono>
#include <deque>
#include <fstream>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "session/running_session.hpp"

namespace ream::test {

/// A session without a simulation: its states are set by hand, its stream says what it is told to.
class FakeSession final : public session::RunningSession {
 public:
  /// The script's name decides what goes wrong: "no-start" refuses to start.
  explicit FakeSession(session::SessionRequest request) : request_(std::move(request)) {
    status_.force_scale = request_.force_scale.value_or(26.0);
    ++alive();
  }
  ~FakeSession() override { --alive(); }

  void start() override {
    if (request_.script == "no-start") throw Error(ErrorKind::unavailable, "no haptic device is connected");
    set(SessionState::running);
  }
  void pause() override { hold(true); }
  void unpause() override { hold(false); }
  bool relabel(const session::SessionRequest& request) override {
    const std::lock_guard lock(mutex_);
    if (!is_live(status_.state)) return false;
    labels_ = request;
    return true;
  }
  session::SessionRequest labels() const {
    const std::lock_guard lock(mutex_);
    return labels_;
  }
  void stop() override {
    set(SessionState::stopped);
    ++stops();
  }

  bool stands_still() const override { return stands_still_; }
  void stand_still(bool still) { stands_still_ = still; }

  session::SessionStatus status() const override {
    const std::lock_guard lock(mutex_);
    return status_;
  }
  nlohmann::json metrics() const override {
    const bool ended = !is_live(status().state);
    return {{"removed_volume_mm3", 12.5},
            {"removed_volume_cortical_mm3", 10.0},
            {"removed_volume_cancellous_mm3", 2.5},
            {"reaming_depth_mm", 0.75},
            {"contact_time_s", 4.0},
            {"contact_spread_mm", 38.0},
            {"axial_thrust_mean_n", 40.0},
            {"axial_thrust_peak_n", 61.0},
            {"weakened_time_s", 0.25},
            {"apparent_stiffness_n_mm", 60.0},
            {"duration_s", 1.5},
            {"force_scale", status().force_scale},
            {"grid_hash", ended ? nlohmann::json("00112233445566ff") : nlohmann::json(nullptr)},
            {"session_hash", "0123456789abcdef"}};
  }
  session::Annotation annotate(const session::NewAnnotation& note) override {
    if (status().state != SessionState::running) throw Error(ErrorKind::conflict, "nothing is recorded");
    const session::Annotation kept{"2025-03-01T12:00:00Z", note.words, note.author, note.at_s.value_or(1.5),
                                   note.place_mm};
    const std::lock_guard lock(mutex_);
    annotations_.push_back(kept);
    return kept;
  }
  std::vector<session::Annotation> annotations() const override {
    const std::lock_guard lock(mutex_);
    return annotations_;
  }
  void write_surface(const std::filesystem::path& ply, int stride) override {
    std::ofstream(ply) << "ply of " << request_.id << " at " << stride;
  }
  void write_picture(const std::filesystem::path& png) override {
    std::ofstream(png) << "png of " << request_.id;
  }
  std::unique_ptr<net::WebSocketSession> subscribe(int stride) override;
  std::unique_ptr<net::WebSocketSession> connect_device() override;

  void set(SessionState state, const std::string& fault = {}) {
    const std::lock_guard lock(mutex_);
    status_.state = state;
    if (state == SessionState::running && status_.tick == 0) status_.tick = 1;  // one that has run
    status_.held &= is_live(state);
    status_.fault = fault;
  }
  const session::SessionRequest& request() const { return request_; }

  static std::atomic<int>& alive() {
    static std::atomic<int> count{0};
    return count;
  }
  static std::atomic<int>& stops() {
    static std::atomic<int> count{0};
    return count;
  }

 private:
  void hold(bool held) {
    set(held ? SessionState::paused : SessionState::running);
    const std::lock_guard lock(mutex_);
    status_.held = held;
  }

  session::SessionRequest request_, labels_;
  mutable std::mutex mutex_;
  session::SessionStatus status_;
  std::vector<session::Annotation> annotations_;
  std::atomic<bool> stands_still_{false};
};

/// Sends "hello <session>" and then whatever the viewer sends, back.
class FakeViewer final : public net::WebSocketSession {
 public:
  explicit FakeViewer(const std::string& session) { waiting_.push_back(net::share("hello " + session)); }
  void on_open(std::function<void()> wake) override { wake_ = std::move(wake); }
  std::optional<net::SharedBytes> next() override {
    if (waiting_.empty()) return std::nullopt;
    net::SharedBytes message = waiting_.front();
    waiting_.pop_front();
    return message;
  }
  void on_message(std::span<const std::byte> message) override {
    waiting_.push_back(std::make_shared<const net::Bytes>(message.begin(), message.end()));
    wake_();
  }
  void on_close() noexcept override {}

 private:
  std::deque<net::SharedBytes> waiting_;
  std::function<void()> wake_;
};

inline std::unique_ptr<net::WebSocketSession> FakeSession::subscribe(int) {
  return std::make_unique<FakeViewer>(request_.id);
}

inline std::unique_ptr<net::WebSocketSession> FakeSession::connect_device() {
  if (request_.device == "script")
    throw Error(ErrorKind::conflict,
                "session '" + request_.id + "' plays a script; no device connects to it");
  return std::make_unique<FakeViewer>("device of " + request_.id);
}

}  // namespace ream::test
