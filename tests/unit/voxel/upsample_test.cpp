#include "voxel/upsample.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/hash.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"

namespace ream::voxel {
namespace {

size_t at(const Vec3i& dims, int u, int v, int w) {
  return static_cast<size_t>(u) +
         static_cast<size_t>(dims.x()) *
             (static_cast<size_t>(v) + static_cast<size_t>(dims.y()) * static_cast<size_t>(w));
}

/// Trilinear by its definition in doubles, for any sample position.
double reference(const std::vector<int16_t>& in, const Vec3i& dims, int n, const Vec3i& out) {
  double sum = 0;
  Vec3i base;
  Vec3 t;
  for (int axis = 0; axis < 3; ++axis) {
    const double p = (out[axis] + 0.5) / n - 0.5;
    base[axis] = static_cast<int>(std::floor(p));
    t[axis] = p - base[axis];
  }
  for (int c = 0; c < 8; ++c) {
    double weight = 1;
    Vec3i o;
    for (int axis = 0; axis < 3; ++axis) {
      const int bit = (c >> axis) & 1;
      weight *= bit ? t[axis] : 1 - t[axis];
      o[axis] = std::clamp(base[axis] + bit, 0, dims[axis] - 1);
    }
    sum += weight * in[at(dims, o.x(), o.y(), o.z())];
  }
  return sum;
}

TEST(Upsample, ConstantStaysConstant) {
  const Vec3i dims(3, 2, 4);
  for (int n = 1; n <= max_upsample_factor; ++n) {
    for (const int value : {0, 1, 127, 255}) {
      const std::vector<uint8_t> in(24, static_cast<uint8_t>(value));
      EXPECT_EQ(upsample_trilinear(std::span<const uint8_t>(in), dims, n),
                std::vector<uint8_t>(24u * static_cast<size_t>(n * n * n), static_cast<uint8_t>(value)));
    }
    for (const int value : {-32768, -1024, -1, 0, 32767}) {
      const std::vector<int16_t> in(24, static_cast<int16_t>(value));
      EXPECT_EQ(upsample_trilinear(std::span<const int16_t>(in), dims, n),
                std::vector<int16_t>(24u * static_cast<size_t>(n * n * n), static_cast<int16_t>(value)));
    }
  }
}

TEST(Upsample, LinearStaysLinearInside) {
  const Vec3i dims(5, 4, 6);
  constexpr int n = 4;
  std::vector<int16_t> in(5 * 4 * 6);
  for (int w = 0; w < 6; ++w)
    for (int v = 0; v < 4; ++v)
      for (int u = 0; u < 5; ++u)
        in[at(dims, u, v, w)] = static_cast<int16_t>(64 * u - 128 * v + 256 * w - 300);
  const auto out = upsample_trilinear(std::span<const int16_t>(in), dims, n);
  for (int w = n; w < 5 * n; ++w)
    for (int v = n; v < 3 * n; ++v)
      for (int u = n; u < 4 * n; ++u) {
        const auto p = [](int i) { return (i + 0.5) / n - 0.5; };
        ASSERT_EQ(out[at(dims * n, u, v, w)], 64 * p(u) - 128 * p(v) + 256 * p(w) - 300);
      }
}

TEST(Upsample, RoundsTheExactValueToNearest) {
  const uint32_t seed = test::seed(7);
  RecordProperty("random_seed", static_cast<int>(seed));
  const Vec3i dims(4, 3, 5);
  std::vector<int16_t> in(60);
  for (size_t i = 0; i < in.size(); ++i) in[i] = static_cast<int16_t>(mix64(seed + i));
  for (const int n : {1, 2, 3, 5, 8, 16}) {
    const auto out = upsample_trilinear(std::span<const int16_t>(in), dims, n);
    ASSERT_EQ(out.size(), in.size() * static_cast<size_t>(n * n * n));
    for (int w = 0; w < dims.z() * n; ++w)
      for (int v = 0; v < dims.y() * n; ++v)
        for (int u = 0; u < dims.x() * n; ++u)
          ASSERT_LE(std::abs(out[at(dims * n, u, v, w)] - reference(in, dims, n, {u, v, w})), 0.5 + 1e-6)
              << n;
  }
}

TEST(Upsample, FactorOneIsTheIdentity) {
  std::vector<uint8_t> in(27);
  for (size_t i = 0; i < in.size(); ++i) in[i] = static_cast<uint8_t>(mix64(i));
  EXPECT_EQ(upsample_trilinear(std::span<const uint8_t>(in), {3, 3, 3}, 1), in);
}

TEST(Upsample, RefusesWhatItCannotDo) {
  const std::vector<uint8_t> in(8);
  const std::span<const uint8_t> view(in);
  test::expect_error(ErrorKind::invalid_input, "factor 0", [&] { upsample_trilinear(view, {2, 2, 2}, 0); });
  test::expect_error(ErrorKind::invalid_input, "factor 17", [&] { upsample_trilinear(view, {2, 2, 2}, 17); });
  test::expect_error(ErrorKind::invalid_input, "size", [&] { upsample_trilinear(view, {2, 2, 3}, 2); });
  test::expect_error(ErrorKind::invalid_input, "without voxels", [&] {
    upsample_trilinear(view, {2, 0, 3}, 2);
  });
}

}  // namespace
}  // namespace ream::voxel
