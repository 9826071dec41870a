#include "ct/hu_volume.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "support/expect_error.hpp"

namespace ream::ct {
namespace {

HuVolume ramp() {
  HuVolume volume;
  volume.dims = {10, 12, 14};
  volume.spacing_mm = {0.5, 1.0, 2.0};
  volume.world_from_volume.translation_mm = {-20, 5, 100};
  volume.hu.resize(volume.voxel_count());
  std::iota(volume.hu.begin(), volume.hu.end(), int16_t{0});
  return volume;
}

TEST(Cropped, KeepsEveryVoxelAtItsPlace) {
  HuVolume volume = ramp();
  volume.world_from_volume.rotation = rotation_from_small_vector({0.3, -0.2, 0.5});
  const Vec3 middle = volume.world_of_centre({5, 6, 7});
  const HuVolume part = cropped(volume, {middle.array() - 1.0, middle.array() + 1.0});
  EXPECT_LT(part.voxel_count(), volume.voxel_count());
  for (int w = 0; w < part.dims.z(); ++w)
    for (int v = 0; v < part.dims.y(); ++v)
      for (int u = 0; u < part.dims.x(); ++u) {
        const Vec3i o = volume.voxel_at_world(part.world_of_centre({u, v, w}));
        ASSERT_EQ(part.hu[part.index(u, v, w)], volume.hu[volume.index(o.x(), o.y(), o.z())]);
      }
}

TEST(Cropped, ABoxOnVoxelBordersTakesExactlyThose) {
  const HuVolume part = cropped(ramp(), {{-19.5, 6.0, 102.0}, {-18.5, 8.0, 106.0}});
  EXPECT_EQ(part.dims, Vec3i(2, 2, 2));
}

TEST(Cropped, RefusesEmptyAndOutside) {
  test::expect_error(ErrorKind::invalid_input, "no volume", [] { cropped(ramp(), {{0, 0, 0}, {0, 1, 1}}); });
  test::expect_error(ErrorKind::invalid_input, "outside the CT", [] {
    cropped(ramp(), {{0, 0, 0}, {1, 1, 1}});
  });
}

TEST(Smooth, KeepsConstantsAndTheSum) {
  HuVolume volume = ramp();
  std::fill(volume.hu.begin(), volume.hu.end(), int16_t{-873});
  smooth(volume, 1.3);
  EXPECT_EQ(std::count(volume.hu.begin(), volume.hu.end(), int16_t{-873}),
            static_cast<std::ptrdiff_t>(volume.hu.size()));
  std::fill(volume.hu.begin(), volume.hu.end(), int16_t{0});
  volume.hu[volume.index(5, 6, 7)] = 30000;
  smooth(volume, 0.6);
  const long sum = std::accumulate(volume.hu.begin(), volume.hu.end(), 0L);
  EXPECT_NEAR(static_cast<double>(sum), 30000.0, 0.02 * 30000.0);
  EXPECT_GT(volume.hu[volume.index(5, 6, 7)], volume.hu[volume.index(6, 6, 7)]);
  EXPECT_EQ(volume.hu[volume.index(6, 6, 7)], volume.hu[volume.index(4, 6, 7)]);
  // Half the spacing along x than along y: the spread in voxels is wider.
  EXPECT_GT(volume.hu[volume.index(6, 6, 7)], volume.hu[volume.index(5, 7, 7)]);
}

TEST(Smooth, RefusesNegativeAndHugeSigma) {
  HuVolume volume = ramp();
  test::expect_error(ErrorKind::invalid_input, "--sigma-mm", [&] { smooth(volume, -1.0); });
  test::expect_error(ErrorKind::invalid_input, "--sigma-mm", [&] { smooth(volume, 50.0); });
}

}  // namespace
}  // namespace ream::ct
