#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "record/recorder.hpp"
#include "record/trace_csv.hpp"
#include "score/metrics.hpp"
#include "session/live/resume_point.hpp"
#include "session/live/session_events.hpp"
#include "session/simulation/simulation.hpp"
#include "sim/haptic_loop.hpp"

namespace ream::session {

/// What a run leaves behind: follows the loop into recording.ream, and where it is wanted trace.csv, and
/// writes metrics.json, timing.json and session.json at the end. All of them hold what the recording keeps
/// (record::as_recorded). Used by one follower thread.
class SessionFiles {
 public:
  enum class Trace { written, left_out };

  /// Opens trace and recording in `folder`, which must exist. `start_coverage` as for record::Recorder.
  /// Error io.
  SessionFiles(const Simulation& simulation, const std::filesystem::path& folder,
               const uint8_t* start_coverage, Trace trace);

  /// Goes on with a session after what was recorded of it. `changed_tool`: it is not the one before.
  SessionFiles(const Simulation& simulation, const std::filesystem::path& folder,
               const uint8_t* start_coverage, const ResumePoint& from, bool changed_tool);

  /// All images of a tick come before its report.
  void add(const voxel::BrickImage& image) { recorder_->add(image); }
  void add(const record::ops::Annotation& annotation) { recorder_->add(annotation); }
  /// Records once that the device that computes failed in that tick; none if negative.
  void note_failover(int64_t tick);
  /// Records with it the events that begin with it. Returns the report as it is kept.
  record::TickReport add(const record::TickReport& report);
  /// What session.json says from the start on.
  const nlohmann::json& description() const { return description_; }
  /// Those of the last report, and what they come from.
  const std::vector<record::ops::Event>& newest_events() const { return newest_events_; }
  const SessionEvents& events() const { return events_; }
  const score::MetricsAccumulator& metrics() const { return metrics_; }
  const record::Recorder& recorder() const { return *recorder_; }

  struct Results {
    nlohmann::json metrics, timing;
  };
  /// Closes and writes everything; only after the loop has ended. `extra` is merged into session.json; its
  /// "fault" is recorded as an event.
  Results finish(const sim::LoopHealth& health, const nlohmann::json& extra);
  /// Lets go of the recording in mid-session, ended in order as `state` for the reason `words` if it can
  /// still be written; nothing else may follow.
  void abandon(const std::string& state, const std::string& words);

 private:
  score::MetricResults bone_results() const;

  const Simulation& simulation_;
  const std::filesystem::path folder_;
  const nlohmann::json description_;  ///< of the simulation before the first tick
  std::optional<record::TraceCsv> trace_;
  std::optional<record::Recorder> recorder_;  ///< until finished or abandoned
  score::MetricsAccumulator metrics_;
  SessionEvents events_;
  std::vector<record::ops::Event> newest_events_;
  uint32_t ticks_ = 0;  ///< recorded so far
  bool failover_noted_ = false;
};

}  // namespace ream::session
