#include "app/recorded_session.hpp"

#include <nlohmann/json.hpp>

#include "app/data_folder.hpp"
#include "app/recorded_rig.hpp"
#include "case/plan.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "sim/model.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

case_::Plan plan_of(const record::Recording& recording) {
  const std::string place = recording.log().path().string() + ", its plan";
  try {
    return case_::plan_from_json(nlohmann::json::parse(recording.header().plan), place);
  } catch (const nlohmann::json::parse_error&) {
    throw Error(ErrorKind::invalid_input, place + ": cannot be read");
  }
}

}  // namespace

fs::path recording_path(const std::string& name, const fs::path& data) {
  std::error_code failed;
  const fs::path given(name);
  if (fs::is_regular_file(given, failed)) return given;
  if (fs::is_directory(given, failed)) {
    if (fs::is_regular_file(given / "recording.ream", failed)) return given / "recording.ream";
    throw Error(ErrorKind::not_found, "the folder " + name + " holds no recording.ream");
  }
  const fs::path kept = sessions_folder(data) / name / "recording.ream";
  if (name.find('/') == std::string::npos && fs::is_regular_file(kept, failed)) return kept;
  throw Error(ErrorKind::not_found, "no session '" + name + "' in " + sessions_folder(data).string() +
                                        ", and no such folder or file; `ream list sessions` lists them");
}

score::MetricsAccumulator accumulated(const record::Recording& recording) {
  const voxel::VoxelGrid grid = recording.grid();
  score::MetricsAccumulator metrics(grid.voxel_volume_mm3(),
                                    sim::world_from_plan(plan_of(recording)).inverse());
  recording.for_each_tick(0, UINT32_MAX, [&](const record::ops::Tick& tick) {
    metrics.add(record::report_of(tick, grid.world_from_grid));
  });
  return metrics;
}

score::Metrics rescored(const record::Recording& recording) { return accumulated(recording).metrics(); }

nlohmann::json rescored_json(const record::Recording& recording) {
  const auto checkpoints = recording.checkpoints();
  const uint64_t grid_hash =
      checkpoints.empty() ? recording.header().start_grid_hash : checkpoints.back().grid_hash;
  return score::metrics_json(rescored(recording), recording.header().force_scale, &grid_hash);
}

case_::Case case_of(const record::Recording& recording, const std::string& case_name, const fs::path& data) {
  case_::Case c = recorded_case(recording, case_name, data);
  case_::cut_pilot_hole(c.bone, *c.plan);
  if (c.bone.coverage_hash() != recording.header().start_grid_hash)
    throw Error(ErrorKind::conflict, "the bone of case '" + c.id + "' is not that of the recording");
  return c;
}

}  // namespace ream::app
