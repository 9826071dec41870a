#pragma once
#include <fstream>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "core/file.hpp"
#include "score/deviation.hpp"
#include "session/folder/session_folder.hpp"
#include "session/service/session_engine.hpp"
#include "support/fake_replay.hpp"
#include "support/fake_session.hpp"

namespace ream::test {

/// Makes fake sessions and replays and remembers them; the case's name decides what goes wrong with a
/// session. Scores and exports are of few words.
class FakeEngine : public session::SessionEngine {
 public:
  std::string program() const override { return "ream of a test"; }
  void make_demo_case() override { demo_case(); }

  std::unique_ptr<session::RunningSession> make(const session::SessionRequest& request) override {
    if (request.case_id == "missing") throw Error(ErrorKind::not_found, "no case 'missing'");
    if (request.case_id == "unplanned") throw Error(ErrorKind::conflict, "case 'unplanned' has no plan");
    if (refuse) refuse();
    auto session = std::make_unique<FakeSession>(request);
    const std::lock_guard lock(mutex_);
    made_.push_back(session.get());
    return session;
  }
  std::unique_ptr<session::RunningSession> resume(const session::SessionRequest& request,
                                                  const std::string& reamer) override {
    if (reamer == "spoon") throw Error(ErrorKind::invalid_input, "no reamer 'spoon'");
    if (reamer == "missing") throw Error(ErrorKind::unavailable, "no device");
    return make(request);
  }
  std::unique_ptr<session::RunningReplay> replay(const session::ReplayRequest& request) override {
    refuse_replay();
    auto replay = std::make_unique<FakeReplay>(request);
    replay->set_unwatched_s(first_unwatched_s);
    const std::lock_guard lock(mutex_);
    replays_.push_back(replay.get());
    return replay;
  }

  /// Of twice the time that metrics.json says, once it may.
  std::unique_ptr<session::SessionMeasurer> measurer() const override {
    return std::make_unique<Measurer>(*this);
  }
  void write_deviations(const std::filesystem::path&, const std::filesystem::path& json,
                        const Progress&) const override {
    wait();
    score::write_deviation(json, "reamed.ply", 4, {{-128, -1, 0, 127}, {}, {}});
  }
  void check_export(const session::ExportFormat& format, const session::ExportOrder& order) const override {
    if (format.is_report() && order.rubric == "nothing")
      throw Error(ErrorKind::not_found, "no rubric 'nothing'");
  }
  void write_export(const session::ExportFormat& format, const session::ExportOrder& order,
                    const std::filesystem::path& out, const Progress& progress) const override {
    progress(0.5, "writing");
    wait();
    std::ofstream(out) << format.name << " of " << order.session.id << " from " << order.part.from_s << " by "
                       << order.part.stride << ", " << order.rubric << " and " << order.benchmark;
  }

  /// In order of making; the caller knows which still live.
  FakeSession& made(size_t index) {
    const std::lock_guard lock(mutex_);
    return *made_.at(index);
  }
  FakeReplay& made_replay(size_t index) {
    const std::lock_guard lock(mutex_);
    return *replays_.at(index);
  }

  std::function<void()> demo_case = [] {};      ///< called when it is to be made
  std::function<void()> refuse;                 ///< called before each session is made
  std::function<void()> refuse_replay = [] {};  ///< and before each replay
  double first_unwatched_s = 1.0;               ///< of replays to be made
  std::atomic<bool> held{false};                ///< scores and exports wait while it is so

 private:
  class Measurer final : public session::SessionMeasurer {
   public:
    explicit Measurer(const FakeEngine& engine) : engine_(engine) {}
    nlohmann::json metrics(const std::filesystem::path& folder, const Progress& progress) override {
      progress(0.5, "measuring");
      engine_.wait();
      progress(0.9, "measuring");
      if (!std::filesystem::exists(session::recording_file(folder)))
        throw Error(ErrorKind::not_found, "it left no recording");
      nlohmann::json metrics = read_json_file(session::metrics_json(folder));
      metrics["duration_s"] = 2.0 * metrics.at("duration_s").get<double>();
      if (folder.filename() == "poorer") metrics["contact_time_s"] = nullptr;
      return metrics;
    }

   private:
    const FakeEngine& engine_;
  };

  void wait() const {
    while (held) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }

  std::mutex mutex_;
  std::vector<FakeSession*> made_;
  std::vector<FakeReplay*> replays_;
};

}  // namespace ream::test
