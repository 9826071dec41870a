#include "session/live/session_files.hpp"

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/log.hpp"
#include "score/bone_results.hpp"
#include "score/metrics.hpp"
#include "session/folder/timing_file.hpp"
#include "session/simulation/recording_header.hpp"

namespace ream::session {
namespace {

void write_json(const std::filesystem::path& path, const nlohmann::json& json) {
  write_file_atomically(path, json.dump(2) + "\n");
}

/// The start of the session stays what it was.
nlohmann::json resumed_description(const Simulation& simulation, const ResumePoint& from) {
  nlohmann::json description = simulation.description();
  description["start_grid_hash"] = to_hex(from.recording().header().start_grid_hash);
  return description;
}

}  // namespace

SessionFiles::SessionFiles(const Simulation& simulation, const std::filesystem::path& folder,
                           const uint8_t* start_coverage, Trace trace)
    : simulation_(simulation),
      folder_(folder),
      description_(simulation.description()),
      recorder_(std::in_place, record::create_log_file(folder / "recording.ream"), header_of(simulation),
                segment_of(simulation, 0, "start"), start_coverage),
      metrics_(simulation.bone_case.bone.grid.voxel_volume_mm3(),
               simulation.model.world_from_plan.inverse()) {
  if (trace == Trace::written)
    trace_.emplace(folder / "trace.csv", simulation.bone_case.bone.grid.voxel_volume_mm3());
}

SessionFiles::SessionFiles(const Simulation& simulation, const std::filesystem::path& folder,
                           const uint8_t* start_coverage, const ResumePoint& from, bool changed_tool)
    : simulation_(simulation),
      folder_(folder),
      description_(resumed_description(simulation, from)),
      recorder_(std::in_place,
                record::continue_log_file(folder / "recording.ream", from.recording().log().whole_bytes()),
                from.recording(), from.bone(),
                segment_of(simulation, from.ticks(), changed_tool ? "reamer" : "resume"), start_coverage),
      metrics_(from.metrics()),
      ticks_(from.ticks()) {}

void SessionFiles::note_failover(int64_t tick) {
  if (tick < 0 || failover_noted_) return;
  failover_noted_ = true;
  recorder_->add(record::ops::Event{static_cast<uint32_t>(tick), "failover", sim::failover_message(tick)});
}

void SessionFiles::abandon(const std::string& state, const std::string& words) {
  if (!recorder_) return;
  try {
    recorder_->add(record::ops::Event{ticks_, state, words});
    recorder_->finish(state);
  } catch (const Error& e) {
    log::warn(folder_.string() + ": the recording could not be ended in order: " + e.what());
  }
  recorder_.reset();
}

record::TickReport SessionFiles::add(const record::TickReport& report) {
  const record::TickReport kept =
      record::as_recorded(report, simulation_.bone_case.bone.grid.world_from_grid);
  if (trace_) trace_->add(kept);
  metrics_.add(kept);
  recorder_->add(report);
  ticks_ = report.tick + 1;
  newest_events_ = events_.of(report);
  for (const record::ops::Event& event : newest_events_) recorder_->add(event);
  return kept;
}

score::MetricResults SessionFiles::bone_results() const {
  if (!simulation_.native) return score::missing_bone_results("the bone before the session is not known");
  const voxel::BoneModel& bone = simulation_.bone_case.bone;
  return score::bone_results(*simulation_.native, {bone.grid, bone.coverage.data()}, metrics_.cut_line(),
                             simulation_.model.world_from_plan, metrics_.reaming_depth_mm());
}

SessionFiles::Results SessionFiles::finish(const sim::LoopHealth& health, const nlohmann::json& extra) {
  if (trace_) trace_->finish();
  note_failover(health.failed_over_tick);
  if (const std::string fault = extra.value("fault", ""); !fault.empty())
    recorder_->add(record::ops::Event{ticks_, extra.value("state", "fault"), fault});
  recorder_->finish(extra.value("state", "finished"));
  recorder_.reset();  // others may append remarks or go on from here
  const uint64_t grid_hash = simulation_.bone_case.bone.coverage_hash();
  Results results{score::session_metrics_json(metrics_, bone_results(),
                                              simulation_.model.settings.force_scale, &grid_hash),
                  timing_file_json(health)};
  write_json(folder_ / "metrics.json", results.metrics);
  write_json(folder_ / "timing.json", results.timing);
  nlohmann::json session = description_;
  if (health.failed_over_tick >= 0) session["failed_over_at_tick"] = health.failed_over_tick;
  session.update(extra);
  write_json(folder_ / "session.json", session);
  return results;
}

}  // namespace ream::session
