#include "bench/memory.hpp"

#include <algorithm>

namespace ream::bench {
namespace {

template <class T>
size_t bytes(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

}  // namespace

size_t memory_of(const OurBone& b) {
  const size_t replica = b.bone.grid.voxel_count();
  return bytes(b.bone.density) + bytes(b.bone.coverage) + replica + bytes(b.distance.bricks) +
         bytes(b.cells.words());
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
