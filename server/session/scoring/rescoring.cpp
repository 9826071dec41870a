#include "session/scoring/rescoring.hpp"

#include <algorithm>

#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/folder_listing.hpp"
#include "core/log.hpp"
#include "record/recorded_bone.hpp"
#include "score/bone_results.hpp"
#include "score/metrics.hpp"
#include "score/planned_face.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/recorded_session.hpp"
#include "session/simulation/recorded_setup.hpp"
#include "session/simulation/session_setup.hpp"
#include "session/simulation/simulation.hpp"
#include "sim/model.hpp"

namespace ream::session {
namespace {

namespace fs = std::filesystem;

uint64_t final_grid_hash(const record::Recording& recording) {
  const auto checkpoint = recording.last_checkpoint();
  return checkpoint ? checkpoint->grid_hash : recording.header().start_grid_hash;
}

/// Why the bone cannot be measured, for everybody who sees the score; places on this machine go to the log.
std::string reason_for_all(const Error& failure) {
  if (failure.kind() == ErrorKind::conflict) return failure.what();
  log::warn(failure.what());
  return "the case of this session is not there, or cannot be read";
}

}  // namespace

void Rescorer::load_case(const record::Recording& recording) {
  const record::ops::Header& header = recording.header();
  if (case_ && case_hash_ == header.case_hash && case_->id == header.case_id) return;
  start_.reset();
  case_.reset();
  case_ = recorded_case(recording, case_name_, data_);
  case_hash_ = header.case_hash;
}

void Rescorer::measure_start(const record::Recording& recording) {
  const record::ops::Header& header = recording.header();
  if (recording.segments().empty())
    throw Error(ErrorKind::invalid_input,
                recording.log().path().string() + " does not say which reamer was used");
  const record::ops::Segment& last = recording.segments().back();
  const std::string said =
      nlohmann::json{header.plan, header.anatomy, last.tool, last.tool_axis, last.tool_file}.dump();
  if (start_ && start_->said == said) return;
  start_.reset();
  case_->plan = recorded_plan(recording);
  const case_::Anatomy anatomy = recorded_anatomy(recording, *case_, case_name_, data_);
  Start start;
  start.said = said;
  start.world_from_plan = sim::world_from_plan(*case_->plan);
  start.glenoid = measured_glenoid(*case_, anatomy, tool_of(recorded_reamer(recording, last)));
  start_ = std::move(start);
}

void Rescorer::cut_start() {
  if (!start_->coverage.empty()) return;
  voxel::BoneModel bone = case_->bone;
  case_::cut_pilot_hole(bone, *case_->plan);
  start_->coverage = std::move(bone.coverage);
}

score::MetricResults Rescorer::bone_results(const record::Recording& recording,
                                            const score::MetricsAccumulator& ticks) const {
  const voxel::VoxelGrid& grid = case_->bone.grid;
  std::vector<uint8_t> left = start_->coverage;
  record::RecordedBone bone(recording, grid, start_->coverage);
  bone.seek(recording.tick_count(), [](const voxel::BrickImage&) {});
  bone.write_to(left);
  return score::bone_results(*start_->glenoid, score::planned_face(*start_->glenoid), {grid, left.data()},
                             ticks.cut_line(), start_->world_from_plan);
}

nlohmann::json Rescorer::metrics(const record::Recording& recording, const Progress& progress) {
  const score::MetricsAccumulator ticks = accumulated(recording, part_of(progress, 0.0, 0.7));
  score::MetricResults of_bone;
  std::string reason;  // why the bone cannot be measured
  const auto attempt = [&](double share, std::string_view words, const auto& work) {
    progress(share, words);
    try {
      if (reason.empty()) work();
    } catch (const Error& e) {
      reason = reason_for_all(e);
    }
  };
  attempt(0.7, "loading the case", [&] { load_case(recording); });
  attempt(0.8, "measuring the untouched bone", [&] { measure_start(recording); });
  attempt(0.85, "cutting the pilot hole", [&] { cut_start(); });
  attempt(0.9, "measuring the bone", [&] { of_bone = bone_results(recording, ticks); });
  if (!reason.empty()) of_bone = score::missing_bone_results(reason);
  progress(1.0, "measured");
  const uint64_t grid_hash = final_grid_hash(recording);
  return score::session_metrics_json(ticks, of_bone, recording.header().force_scale, &grid_hash);
}

std::vector<Rescored> rescore(std::span<const std::string> names, const std::string& case_name,
                              const fs::path& data, const Progress& progress) {
  Rescorer rescorer(data, case_name);
  std::vector<Rescored> all;
  const double step = names.empty() ? 0.0 : 1.0 / static_cast<double>(names.size());
  for (const std::string& name : names) {
    const double begun = static_cast<double>(all.size()) * step;
    bool ended = false;  // by the progress: about everything, not about this session
    const Progress of_this = [&](double share, std::string_view) {
      ended = true;
      progress(begun + share * step, name);
      ended = false;
    };
    of_this(0.0, {});
    Rescored one{name, nullptr, {}, {}};
    try {
      const record::Recording recording(recording_path(name, data), record::Recording::Trust::checked);
      if (const std::string& damage = recording.log().damage(); !damage.empty()) log::warn(damage);
      one.metrics = rescorer.metrics(recording, of_this);
    } catch (const Error& e) {
      if (ended) throw;
      one.error = e.what();
      one.kind = e.kind();
    }
    all.push_back(std::move(one));
  }
  progress(1.0, "done");
  return all;
}

std::vector<std::string> recorded_sessions(const fs::path& data) {
  std::vector<std::string> names;
  std::error_code unknown;
  for (const fs::path& session : paths_in(sessions_folder(data)))
    if (fs::is_regular_file(session / "recording.ream", unknown))
      names.push_back(session.filename().string());
  return names;
}

}  // namespace ream::session
