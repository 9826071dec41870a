#pragma once
#include "collide/bone_buffers.hpp"
#include "every_device.hpp"
#include "reaming_scene.hpp"
#include "support/full_tests.hpp"

namespace ream::test {

/// A bone of its own, as `seed` makes it, for every launch shape: what takes bone is compared on these.
/// `check(scene, buffers, shape)`; the buffers are in `parts` parts.
template <class Check>
void with_every_shape(unsigned seed, const Vec3i& dims, const gpu::Device& device,
                      std::optional<size_t> max_buffer_bytes, int parts, Check check) {
  for (const collide::LaunchShape shape : {collide::LaunchShape{1, 1}, {16, 1}, {3, 8}, {2, 64}}) {
    SCOPED_TRACE(std::to_string(shape.groups) + " groups of " + std::to_string(shape.lanes));
    ReamingScene scene(seed, dims);
    const auto buffers = std::make_shared<collide::BoneBuffers>(device, scene.bone, max_buffer_bytes);
    ASSERT_EQ(buffers->parts.count, parts);
    check(scene, buffers, shape);
  }
}

/// Poses (in full tests 200, else 50) on each of the grids that are cut into parts, on every device:
/// `compare(expected, seed, device, max_buffer_bytes, parts)`. More than half of them must change bone.
template <class Expected, class Compare>
void in_small_parts(unsigned seed, Compare compare) {
  std::cout << "seed " << seed << '\n';
  for (const auto& [dims, max_buffer_bytes, parts] : small_parts) {
    SCOPED_TRACE(std::to_string(parts) + " parts");
    const int poses = tried_of(200, 50);
    const Expected expected(seed, dims, poses);
    EXPECT_GT(expected.changed, poses / 2);
    on_every_device([&, limit = max_buffer_bytes, count = parts](const gpu::Device& device) {
      compare(expected, seed, device, limit, count);
    });
  }
}

}  // namespace ream::test
