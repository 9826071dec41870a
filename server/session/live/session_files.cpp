#include "session/live/session_files.hpp"

#include <algorithm>

#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/log.hpp"
#include "core/new_id.hpp"
#include "record/op_log.hpp"
#include "score/bone_results.hpp"
#include "score/planned_face.hpp"
#include "session/folder/black_box_files.hpp"
#include "session/folder/session_folder.hpp"
#include "session/folder/session_labels.hpp"
#include "session/folder/timing_file.hpp"
#include "session/live/session_recovery.hpp"
#include "session/scoring/score_document.hpp"
#include "session/simulation/recording_header.hpp"

namespace ream::session {
namespace {

namespace fs = std::filesystem;

/// The start of the session stays what it was.
nlohmann::json resumed_description(const Simulation& simulation, const ResumePoint& from) {
  nlohmann::json description = simulation.description();
  description["start_grid_hash"] = to_hex(from.recording().header().start_grid_hash);
  return description;
}

record::ops::Segment resumed_segment(const Simulation& simulation, const ResumePoint& from) {
  const bool same_reamer = simulation.reamer.words == from.recording().segments().back().tool;
  return segment_of(simulation, from.ticks(), same_reamer ? "resume" : "reamer");
}

}  // namespace

SessionFiles::SessionFiles(const Simulation& simulation, const fs::path& folder,
                           const uint8_t* start_coverage, Trace trace)
    : simulation_(simulation),
      folder_(folder),
      created_utc_(utc_now()),
      description_(simulation.description()),
      recorder_(std::in_place, record::create_log_file(recording_file(folder)), header_of(simulation),
                segment_of(simulation, 0, "start"), start_coverage),
      metrics_(simulation.bone_case.bone.grid.voxel_volume_mm3(),
               simulation.model.world_from_plan.inverse()) {
  if (trace == Trace::written)
    trace_.emplace(folder / "trace.csv", simulation.bone_case.bone.grid.voxel_volume_mm3(),
                   simulation.model.world_from_plan.inverse());
}

SessionFiles::SessionFiles(const Simulation& simulation, const fs::path& folder,
                           const uint8_t* start_coverage, const ResumePoint& from)
    : simulation_(simulation),
      folder_(folder),
      description_(resumed_description(simulation, from)),
      recorder_(std::in_place,
                record::continue_log_file(recording_file(folder), from.recording().log().whole_bytes()),
                from.recording(), from.bone(), resumed_segment(simulation, from), start_coverage),
      metrics_(from.metrics()),
      ticks_(from.ticks()) {}

/// The recording first: what session.json calls running has one.
std::unique_ptr<SessionFiles> SessionFiles::open(const Simulation& simulation, const fs::path& data,
                                                 const SessionRequest& request, const uint8_t* start_coverage,
                                                 ResumePoint* from) {
  const fs::path folder = sessions_folder(data) / request.id;
  make_writable_folder(folder);
  if (!from) {
    FileLock lock = locked(folder);
    auto files = std::make_unique<SessionFiles>(simulation, folder, start_coverage, Trace::left_out);
    files->own(data, request);
    files->lock_ = std::move(lock);
    return files;
  }
  try {
    std::unique_ptr<SessionFiles> files(new SessionFiles(simulation, folder, start_coverage, *from));
    files->own(data, request);
    files->lock_ = from->take_lock();
    return files;
  } catch (const std::exception&) {
    from->cut_to_its_end();
    throw;
  }
}

/// Results of an earlier part of the session do not outlive its going on.
void SessionFiles::own(const fs::path& data, const SessionRequest& request) {
  data_ = data;
  relabel(request);
  std::error_code ignored;
  for (const char* result : {"reamed.ply", "snapshot.png", "deviation.json", "deviation.bin"})
    fs::remove(folder_ / result, ignored);
}

void SessionFiles::relabel(const SessionRequest& request) {
  request_ = request;
  nlohmann::json session = description_;
  session.update(session_document({SessionState::running}));
  write_json_file(session_json(folder_), session);
}

/// What session.json says of a live session beside what describes the simulation.
nlohmann::json SessionFiles::session_document(const RunEnd& end) const {
  nlohmann::json document = {{"id", request_->id},
                             {"state", to_text(end.state)},
                             {"created_utc", request_->created_utc},
                             {"script", request_->script},
                             {"device", request_->device}};
  if (!end.fault.empty()) document["fault"] = end.fault;
  if (!is_live(end.state)) document["ticks"] = end.ticks;
  write_labels(*request_, document);
  return document;
}

void SessionFiles::write_black_box(const sim::BlackBox& box, uint32_t tick) const {
  try {
    const fs::path path = session::write_black_box(box, folder_, tick);
    log::info("session " + request_->id + ": the last seconds are in " + path.string());
  } catch (const std::exception& e) {
    log::error("session " + request_->id + ": its black box could not be written: " + e.what());
  }
}

void SessionFiles::note_failover(int64_t tick) {
  if (tick < 0 || failover_noted_) return;
  failover_noted_ = true;
  recorder_->add(record::ops::Event{static_cast<uint32_t>(tick), "failover", sim::failover_message(tick)});
}

void SessionFiles::abandon(SessionState state, const std::string& words) {
  if (!recorder_) return;
  try {
    recorder_->add(record::ops::Event{ticks_, to_text(state), words});
    recorder_->finish(to_text(state));
  } catch (const Error& e) {
    log::warn(folder_.string() + ": the recording could not be ended in order: " + e.what());
  }
  recorder_.reset();
}

nlohmann::json SessionFiles::abandon_session(SessionState state, const std::string& words,
                                             std::span<const record::ops::Annotation> accepted) {
  abandon(state, words);
  close_session_folder(folder_, data_, state, words);
  const record::Recording recording(recording_file(folder_));
  std::vector<record::Note> missing;
  for (size_t i = recording.annotations().size(); i < accepted.size(); ++i) {
    record::ops::Annotation annotation = accepted[i];
    annotation.tick = std::min(annotation.tick, recording.tick_count());
    missing.emplace_back(annotation);
  }
  if (!missing.empty()) record::append_notes(recording.log(), missing);
  return read_json_file(metrics_json(folder_));
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
  return score::bone_results(*simulation_.native, score::planned_face(*simulation_.native),
                             {bone.grid, bone.coverage.data()}, metrics_.cut_line(),
                             simulation_.model.world_from_plan);
}

SessionFiles::Results SessionFiles::finish(const sim::LoopHealth& health, const RunEnd& end) {
  if (trace_) trace_->finish();
  note_failover(health.failed_over_tick);
  if (!end.fault.empty()) recorder_->add(record::ops::Event{ticks_, to_text(end.state), end.fault});
  recorder_->finish(to_text(end.state));
  recorder_.reset();  // others may append remarks or go on from here
  const uint64_t grid_hash = simulation_.bone_case.bone.coverage_hash();
  Results results{score::session_metrics_json(metrics_, bone_results(),
                                              simulation_.model.settings.force_scale, &grid_hash),
                  timing_file_json(health)};
  write_json_file(metrics_json(folder_), results.metrics);
  write_json_file(folder_ / "timing.json", results.timing);
  nlohmann::json session = description_;
  session["created_utc"] = created_utc_;
  if (health.failed_over_tick >= 0) session["failed_over_at_tick"] = health.failed_over_tick;
  if (request_) session.update(session_document(end));
  write_json_file(session_json(folder_), session);
  if (request_) keep_score(folder_, data_);
  return results;
}

}  // namespace ream::session
