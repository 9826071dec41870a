#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "collide/removal/removal_schedule.hpp"
#include "record/tick_report.hpp"
#include "shell/swept_profile.hpp"
#include "shell/tool.hpp"
#include "twin/cause_parts.hpp"

namespace ream::test {

/// A block of bone in the far corner of a grid, 64 voxels wide, its upper 8 voxels gone.
inline voxel::BoneModel corner_block(const Vec3i& dims, const Vec3& spacing_mm) {
  voxel::BoneModel bone;
  bone.grid.dims = dims;
  bone.grid.spacing_mm = spacing_mm;
  bone = voxel::make_bone(bone.grid);
  const Vec3i low = (dims.array() - 64).max(0);
  for (int w = low.z(); w < dims.z() - 8; ++w)
    for (int v = low.y(); v < dims.y(); ++v)
      for (int u = low.x(); u < dims.x(); ++u) bone.coverage[bone.grid.index(u, v, w)] = 255;
  return bone;
}

/// A reamer that turns, wobbles and sinks into the block from above; every seventh tick it does not cut.
inline std::vector<twin::CauseTick> sinking_reamer(const voxel::VoxelGrid& grid, uint32_t count) {
  const Vec3 top_mm = (grid.dims.cast<double>() - Vec3(32.0, 32.0, 8.0)).cwiseProduct(grid.spacing_mm);
  Mat3 down = Mat3::Identity();
  down(1, 1) = down(2, 2) = -1.0;
  std::vector<twin::CauseTick> ticks(count);
  for (uint32_t i = 0; i < count; ++i) {
    const double t = i;
    Pose pose;
    pose.rotation =
        rotation_from_small_vector({0.02 * std::sin(0.01 * t), 0.03 * std::cos(0.013 * t), 0.0}) * down;
    pose.translation_mm = top_mm + Vec3(0.2 * std::sin(0.02 * t), 0.1 * std::cos(0.03 * t), 0.1 - 0.003 * t);
    const uint32_t cuts = i % 7 != 0 ? record::engaged_flag | record::cutting_flag : 0u;
    ticks[i] = {i, record::spindle_on_flag | cuts, quantised(pose)};
  }
  return ticks;
}

/// What a session that reams the block has for parts, its hashes by the twin of this program.
inline std::vector<twin::Bytes> reamed_parts(const Vec3i& dims, const Vec3& spacing_mm, uint32_t count) {
  voxel::BoneModel bone = corner_block(dims, spacing_mm);
  const shell::SweptProfile profile = shell::swept_profile(
      shell::make_tool("sphere 4,2").profile, collide::RemovalSchedule::needed_margin_mm(bone.grid));
  std::vector<twin::Bytes> parts = {twin::start_part(bone), twin::segment_part(0, profile)};
  twin::BoneTwin twin(std::move(bone));
  twin.begin_segment(profile);
  const std::vector<twin::CauseTick> ticks = sinking_reamer(twin.bone().grid, count);
  for (size_t first = 0; first < ticks.size(); first += 100) {
    const auto rows = std::span(ticks).subspan(first, std::min<size_t>(100, ticks.size() - first));
    for (const twin::CauseTick& tick : rows) twin.step(tick);
    parts.push_back(twin::ticks_part(rows, twin.session_hash()));
  }
  parts.push_back(twin::end_part(count, twin.bone().coverage_hash(), count));
  return parts;
}

}  // namespace ream::test
