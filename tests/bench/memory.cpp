#include "bench/memory.hpp"

#include <algorithm>

#include "collide/removal/removal_schedule.hpp"
#include "shell/swept_profile.hpp"
#include "voxel/bricks.hpp"

namespace ream::bench {
namespace {

template <class T>
size_t bytes(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

}  // namespace

size_t memory_of(const OurBone& b) {
  const size_t replica = b.bone.grid.voxel_count();
  const shell::SweptProfile profile = shell::swept_profile(
      shell::make_tool(shell::thesis_tool).profile, collide::RemovalSchedule::needed_margin_mm(b.bone.grid));
  const collide::RemovalSchedule schedule(profile, b.bone);
  voxel::BrickRing ring(2);
  const voxel::BrickSender sender(b.bone.grid, ring);
  return b.bone.density.size() + bytes(b.bone.coverage) + replica + bytes(b.distance.bricks) +
         bytes(b.cells.words()) + schedule.bytes() + sender.bytes();
}

size_t coverage_in_uniform_bricks(const voxel::BoneModel& bone) {
  size_t uniform = 0;
  for (uint32_t brick = 0; brick < bone.grid.brick_count(); ++brick) {
    const uint8_t* first = bone.coverage.data() + bone.grid.brick_base(brick);
    const bool extreme = *first == 0 || *first == 255;
    uniform +=
        extreme && std::all_of(first, first + voxel::brick_voxels, [&](uint8_t c) { return c == *first; });
  }
  return uniform * voxel::brick_voxels;
}

}  // namespace ream::bench
