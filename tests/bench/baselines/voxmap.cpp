#include "bench/baselines/voxmap.hpp"

#include <algorithm>
#include <cstring>

namespace ream::bench {
namespace {

constexpr uint8_t filled_coverage = 128;

/// A run of 8 voxels along x lies together in the bone's arrays. Returns the first and last filled one, or
/// -1.
struct Run {
  int first = -1, last = -1;
};

Run copy_run(const uint8_t* coverage, const uint8_t* density, uint8_t* gray) {
  uint64_t any = 0;
  std::memcpy(&any, coverage, sizeof any);
  Run run;
  if (any == 0) return run;
  for (int i = 0; i < voxel::brick_edge; ++i) {
    if (coverage[i] < filled_coverage) continue;
    gray[i] = std::max<uint8_t>(density[i], 1);
    if (run.first < 0) run.first = i;
    run.last = i;
  }
  return run;
}

}  // namespace

voxel::VoxelGrid Voxmap::grid() const {
  voxel::VoxelGrid grid;
  grid.dims = dims;
  grid.spacing_mm = spacing_mm;
  return grid;
}

Voxmap voxmap_of(const voxel::BoneModel& bone) {
  const voxel::VoxelGrid& grid = bone.grid;
  Voxmap map{grid.dims, grid.spacing_mm, std::vector<uint8_t>(grid.voxel_count()), {}};
  Vec3i low = grid.dims, high = Vec3i::Constant(-1);
  uint8_t* row = map.gray.data();
  for (int w = 0; w < grid.dims.z(); ++w)
    for (int v = 0; v < grid.dims.y(); ++v)
      for (int u = 0; u < grid.dims.x(); u += voxel::brick_edge, row += voxel::brick_edge) {
        const size_t from = grid.index(u, v, w);
        const Run run = copy_run(bone.coverage.data() + from, bone.density.data() + from, row);
        if (run.first < 0) continue;
        low = low.cwiseMin(Vec3i(u + run.first, v, w));
        high = high.cwiseMax(Vec3i(u + run.last, v, w));
      }
  if ((high.array() < 0).any()) return map;
  map.bone_box_mm.include((low.cast<double>().array() * grid.spacing_mm.array()).matrix());
  map.bone_box_mm.include(((high.cast<double>().array() + 1.0) * grid.spacing_mm.array()).matrix());
  return map;
}

}  // namespace ream::bench
