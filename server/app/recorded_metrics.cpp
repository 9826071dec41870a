#include "app/recorded_metrics.hpp"

#include "app/data_folder.hpp"
#include "case/plan.hpp"
#include "core/error.hpp"
#include "sim/model.hpp"

namespace ream::app {
namespace {

/// Takes checkpoints and lets all other ops pass.
struct LastCheckpoint {
  std::optional<record::ops::Checkpoint> found;
  void operator()(const record::ops::Checkpoint& op) { found = op; }
  template <typename Other>
  void operator()(const Other&) {}
};

Pose recorded_world_from_plan(const record::Recording& recording) {
  const std::string place = recording.log().path().string() + ": plan";
  try {
    return sim::world_from_plan(case_::plan_from_json(nlohmann::json::parse(recording.header().plan), place));
  } catch (const nlohmann::json::exception&) {
    throw Error(ErrorKind::invalid_input, place + " is not JSON");
  }
}

}  // namespace

case_::Case recorded_case_description(const record::Recording& recording, const std::filesystem::path& data) {
  const std::string& id = recording.header().case_id;
  case_::Case bone_case = case_::load_case_description(cases_folder(data) / id);
  const auto description = nlohmann::json::parse(recording.header().description, nullptr, false);
  const Vec3i& dims = bone_case.bone.grid.dims;
  const nlohmann::json here = {dims.x(), dims.y(), dims.z()};
  if (!description.is_object() || description.value("grid_dims", here) != here)
    throw Error(ErrorKind::conflict,
                "case '" + id + "' has another grid than the one in " + recording.log().path().string());
  return bone_case;
}

score::MetricsAccumulator recorded_metrics(const record::Recording& recording, const case_::Case& bone_case) {
  const voxel::VoxelGrid& grid = bone_case.bone.grid;
  score::MetricsAccumulator metrics(grid.voxel_volume_mm3(), recorded_world_from_plan(recording).inverse());
  recording.for_each_tick(0, recording.tick_count(), [&](const record::ops::Tick& tick) {
    metrics.add(record::report_of(tick, grid.world_from_grid));
  });
  return metrics;
}

nlohmann::json recorded_metrics_json(const record::Recording& recording, const case_::Case& bone_case) {
  const std::optional<uint64_t> grid_hash = recorded_grid_hash(recording);
  return score::metrics_json(recorded_metrics(recording, bone_case).metrics(), recording.header().force_scale,
                             grid_hash ? &*grid_hash : nullptr);
}

std::optional<uint64_t> recorded_grid_hash(const record::Recording& recording) {
  if (recording.tick_count() == 0) return recording.header().start_grid_hash;
  LastCheckpoint last;
  record::ops::read(recording.log().read_chunk(recording.chunk_of(recording.tick_count())),
                    recording.log().revision(), last);
  if (!last.found) return std::nullopt;
  return last.found->grid_hash;
}

}  // namespace ream::app
