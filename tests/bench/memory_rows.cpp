#include "bench/collide_parts.hpp"
#include "bench/memory.hpp"

namespace ream::bench {

std::vector<Row> memory_rows(const case_::Case& bone_case, const shell::PointShell& shell) {
  constexpr double goal_bytes_a_voxel = 3.0 * 1.01, goal_bytes_a_point = 8.0, mb = 1e6;
  OurBone bone(bone_case.bone);
  const OurContact contact(bone, shell);
  const auto voxels = static_cast<double>(bone.bone.grid.voxel_count());
  const auto points = static_cast<double>(shell.points.size());
  return {{"collide", "thesis-5-4-2 memory a voxel, replica included",
           static_cast<double>(memory_of(bone)) / voxels, 0.0, "bytes", goal_bytes_a_voxel},
          {"collide", "thesis-5-4-2 memory a shell point",
           static_cast<double>(contact.shell().bytes()) / points, 0.0, "bytes", goal_bytes_a_point},
          {"collide", "thesis-5-4-2 coverage of uniform bricks, not worth keeping (baseline: all)",
           static_cast<double>(coverage_in_uniform_bricks(bone.bone)) / mb, voxels / mb, "MB", 0.0}};
}

}  // namespace ream::bench
