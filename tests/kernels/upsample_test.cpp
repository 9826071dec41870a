#include "voxel/upsample_cl.hpp"

#include <random>

#include "core/error.hpp"
#include "every_device.hpp"

namespace ream::voxel {
namespace {

template <typename T>
std::vector<T> random_volume(const Vec3i& dims, std::mt19937& random) {
  std::uniform_int_distribution<int> value(std::numeric_limits<T>::min(), std::numeric_limits<T>::max());
  std::vector<T> volume(static_cast<size_t>(dims.prod()));
  for (T& v : volume) v = static_cast<T>(value(random));
  return volume;
}

template <typename T>
void expect_equal_bits() {
  std::cout << "seed 51\n";
  test::on_every_device([](const gpu::Device& device) {
    const gpu::Queue queue(device);
    std::mt19937 random(51);
    for (const Vec3i& dims : {Vec3i(1, 1, 1), Vec3i(7, 5, 3), Vec3i(21, 6, 9)})
      for (const int factor : {1, 2, 3, 8, 16}) {
        const std::vector<T> input = random_volume<T>(dims, random);
        EXPECT_EQ(upsample_trilinear_cl(queue, std::span<const T>(input), dims, factor),
                  upsample_trilinear(std::span<const T>(input), dims, factor))
            << "factor " << factor;
      }
  });
}

TEST(UpsampleCl, BytesEqualTheCppTwin) { expect_equal_bits<uint8_t>(); }
TEST(UpsampleCl, ShortsEqualTheCppTwin) { expect_equal_bits<int16_t>(); }

TEST(UpsampleCl, RefusesWhatTheCppTwinRefuses) {
  const gpu::Queue queue(gpu::choose_device("auto", gpu::Use::bulk));
  const std::vector<uint8_t> eight(8);
  EXPECT_THROW(upsample_trilinear_cl(queue, std::span<const uint8_t>(eight), Vec3i(2, 2, 2), 0), Error);
  EXPECT_THROW(upsample_trilinear_cl(queue, std::span<const uint8_t>(eight), Vec3i(2, 2, 2), 17), Error);
  EXPECT_THROW(upsample_trilinear_cl(queue, std::span<const uint8_t>(eight), Vec3i(2, 2, 3), 2), Error);
}

}  // namespace
}  // namespace ream::voxel
