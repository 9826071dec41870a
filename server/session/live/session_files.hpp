#pragma once
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "record/recorder.hpp"
#include "record/trace_csv.hpp"
#include "score/metrics.hpp"
#include "session/live/resume_point.hpp"
#include "session/live/session_events.hpp"
#include "session/running_session.hpp"
#include "session/simulation/simulation.hpp"
#include "sim/black_box.hpp"
#include "sim/loop_health.hpp"

namespace ream::session {

/// How a run ended, for its recording and session.json.
struct RunEnd {
  SessionState state = SessionState::finished;
  std::string fault = {};  ///< empty: none
  uint32_t ticks = 0;
};

/// What a run leaves behind: follows the loop into recording.ream, and where it is wanted trace.csv, and
/// writes metrics.json, timing.json and session.json at the end. All of them hold what the recording keeps
/// (record::as_recorded). That of a live session has labels too, and holds the folder's lock; it is opened on
/// the thread that starts the session and from then on used by the follower only.
class SessionFiles {
 public:
  enum class Trace { written, left_out };

  /// Of a run without labels. Opens trace and recording in `folder`, which must exist. `start_coverage` as
  /// for record::Recorder. Error io.
  SessionFiles(const Simulation& simulation, const std::filesystem::path& folder,
               const uint8_t* start_coverage, Trace trace);

  /// Those of a live session in the data folder `data`; session.json says then that it runs. `from`: goes on
  /// there, whose lock it takes; null: new. Errors: conflict when another process has the folder; io. On an
  /// error a recording that was to go on is as it was.
  static std::unique_ptr<SessionFiles> open(const Simulation& simulation, const std::filesystem::path& data,
                                            const SessionRequest& request, const uint8_t* start_coverage,
                                            ResumePoint* from);

  /// All images of a tick come before its report.
  void add(const voxel::BrickImage& image) { recorder_->add(image); }
  void add(const record::ops::Annotation& annotation) { recorder_->add(annotation); }
  /// Records with it the events that begin with it. Returns the report as it is kept.
  record::TickReport add(const record::TickReport& report);
  /// Records once that the device that computes failed in that tick; none if negative.
  void note_failover(int64_t tick);
  /// Writes session.json with these labels.
  void relabel(const SessionRequest& request);
  /// The last seconds before `tick`, beside the recording. What fails is logged.
  void write_black_box(const sim::BlackBox& box, uint32_t tick) const;

  /// Those of the last report, and what they come from.
  const std::vector<record::ops::Event>& newest_events() const { return newest_events_; }
  const SessionEvents& events() const { return events_; }
  const score::MetricsAccumulator& metrics() const { return metrics_; }
  const record::Recorder& recorder() const { return *recorder_; }

  struct Results {
    nlohmann::json metrics, timing;
  };
  /// Closes and writes everything, a live session's score too; only after the loop has ended.
  Results finish(const sim::LoopHealth& health, const RunEnd& end = {});
  /// Lets go of the recording in mid-session, ended in order as `state` for the reason `words` if it can
  /// still be written; nothing else may follow.
  void abandon(SessionState state, const std::string& words);
  /// Abandons a live session's, closes its folder as it is after a crash, and appends those of the accepted
  /// annotations that the recording does not have. Returns metrics.json. Error io: the next start of the
  /// server does it.
  nlohmann::json abandon_session(SessionState state, const std::string& words,
                                 std::span<const record::ops::Annotation> accepted);

 private:
  SessionFiles(const Simulation& simulation, const std::filesystem::path& folder,
               const uint8_t* start_coverage, const ResumePoint& from);
  void own(const std::filesystem::path& data, const SessionRequest& request);
  score::MetricResults bone_results() const;
  nlohmann::json session_document(const RunEnd& end) const;

  std::optional<FileLock> lock_;  ///< of a live session's folder; let go of when all else is closed
  const Simulation& simulation_;
  const std::filesystem::path folder_;
  std::filesystem::path data_;             ///< of a live session
  std::optional<SessionRequest> request_;  ///< of a live session, with its newest labels
  const std::string created_utc_;          ///< of a headless session; a live one's is in its request
  const nlohmann::json description_;       ///< of the simulation before the first tick
  std::optional<record::TraceCsv> trace_;
  std::optional<record::Recorder> recorder_;  ///< until finished or abandoned
  score::MetricsAccumulator metrics_;
  SessionEvents events_;
  std::vector<record::ops::Event> newest_events_;
  uint32_t ticks_ = 0;  ///< recorded so far
  bool failover_noted_ = false;
};

}  // namespace ream::session
