#include "app/rescoring.hpp"

#include <algorithm>

#include "app/data_folder.hpp"
#include "app/measured_glenoid.hpp"
#include "app/recorded_rig.hpp"
#include "app/recorded_session.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "record/recorded_bone.hpp"
#include "score/session_metrics.hpp"
#include "score/surface_findings.hpp"
#include "sim/model.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

uint64_t final_grid_hash(const record::Recording& recording) {
  const auto checkpoint = recording.last_checkpoint();
  return checkpoint ? checkpoint->grid_hash : recording.header().start_grid_hash;
}

}  // namespace

/// A copy for each session, as reaming changes it; copies share their density.
case_::Case Rescorer::native_case(const record::Recording& recording) {
  const record::ops::Header& header = recording.header();
  if (!case_ || case_hash_ != header.case_hash || case_->id != header.case_id) {
    case_.reset();
    case_ = recorded_case(recording, case_name_, data_);
    case_hash_ = header.case_hash;
  }
  case_::Case native = *case_;
  native.plan = recorded_plan(recording);
  return native;
}

score::Findings Rescorer::bone_findings(const record::Recording& recording,
                                        const score::MetricsAccumulator& ticks) {
  case_::Case bone_case = native_case(recording);
  const case_::Anatomy anatomy = recorded_anatomy(recording, bone_case, case_name_, data_);
  const shell::Tool reamer = tool_of(recorded_reamer(recording, recording.segments().back()));
  const auto native = measured_glenoid(bone_case, anatomy, reamer);
  case_::cut_pilot_hole(bone_case.bone, *bone_case.plan);
  std::vector<uint8_t> left = bone_case.bone.coverage;
  record::RecordedBone bone(recording, bone_case.bone.grid, bone_case.bone.coverage);
  bone.seek(recording.tick_count(), [](const voxel::BrickImage&) {});
  bone.write_to(left);
  return score::surface_findings(*native, {bone_case.bone.grid, left.data()}, ticks.cut_line(),
                                 sim::world_from_plan(*bone_case.plan), ticks.metrics().reaming_depth_mm);
}

nlohmann::json Rescorer::metrics(const record::Recording& recording, const Progress& progress) {
  const score::MetricsAccumulator ticks = accumulated(recording, part_of(progress, 0.0, 0.8));
  progress(0.8, "measuring the bone");
  score::Findings of_bone;
  try {
    of_bone = bone_findings(recording, ticks);
  } catch (const Error& e) {
    of_bone = score::bone_unsaid(e.what());
  }
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
    const Progress of_this = [&](double share, std::string_view) { progress(begun + share * step, name); };
    of_this(0.0, {});
    Rescored one{name, nullptr, {}, {}};
    try {
      const record::Recording recording(recording_path(name, data), record::Recording::Trust::checked);
      if (const std::string& damage = recording.log().damage(); !damage.empty()) log::warn(damage);
      one.metrics = rescorer.metrics(recording, of_this);
    } catch (const Error& e) {
      // What the progress throws ends everything; what the recording does is about this session.
      of_this(1.0, {});
      if (e.kind() == ErrorKind::cancelled) throw;
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
  std::error_code failed;
  for (fs::directory_iterator next(sessions_folder(data), failed), end; !failed && next != end;
       next.increment(failed)) {
    std::error_code unknown;
    if (fs::is_regular_file(next->path() / "recording.ream", unknown))
      names.push_back(next->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace ream::app
