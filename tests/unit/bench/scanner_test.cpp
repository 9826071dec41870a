#include "bench/validate/scanner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "bench/validate/parallel.hpp"
#include "bench/validate/published_density.hpp"
#include "statistics/sample.hpp"
#include "support/temporary_folder.hpp"

namespace ream::bench {
namespace {

constexpr ScanProtocol without_noise{"quiet", 0.5, 0.75, 0.3, 0.0};
const Aabb field{Vec3(-6.0, -5.0, -7.5), Vec3(6.0, 5.0, 7.5)};

TEST(Scanner, WhatIsTheSameEverywhereStaysWhatItIs) {
  const Scan scan = take_scan([](const Vec3&) { return 123.0; }, field, without_noise, 1);
  EXPECT_EQ(scan.dims, Vec3i(24, 20, 20));
  for (const int16_t hu : scan.hu) ASSERT_EQ(hu, 123);
}

/// Integral of the normal distribution up to x.
double integral_of_normal(double x) {
  return x * 0.5 * std::erfc(-x / std::sqrt(2.0)) + std::exp(-0.5 * x * x) / std::sqrt(2.0 * M_PI);
}

TEST(Scanner, AnEdgeIsBlurredAndAveragedAsItsIntegralSays) {
  constexpr double edge_mm = 0.13, step_hu = 1000.0;
  const Scan scan =
      take_scan([&](const Vec3& at) { return at.x() < edge_mm ? 0.0 : step_hu; }, field, without_noise, 1);
  const double blur = without_noise.blur_mm, pixel = without_noise.pixel_mm;
  for (int u = 4; u < 20; ++u) {
    const double from = (scan.corner_mm.x() + u * pixel - edge_mm) / blur, to = from + pixel / blur;
    const double truth = step_hu * (integral_of_normal(to) - integral_of_normal(from)) / (to - from);
    // Half a cell of 0.17 mm is not resolved, at the steepest 1.33 per mm.
    EXPECT_NEAR(scan.hu[static_cast<size_t>(u)], truth, 1.33 * step_hu * 0.085) << u;
  }
}

TEST(Scanner, BlurAndVoxelsKeepTheSum) {
  const auto ball = [](const Vec3& at) { return at.norm() < 3.0 ? 1000.0 : 0.0; };
  const Scan scan = take_scan(ball, field, without_noise, 1);
  double sum = 0.0;
  for (const int16_t hu : scan.hu) sum += hu;
  const double volume_mm3 = 4.0 / 3.0 * M_PI * 27.0;
  EXPECT_NEAR(sum * scan.spacing_mm.prod() / 1000.0, volume_mm3, 0.01 * volume_mm3);
}

TEST(Scanner, NoiseIsAsStrongAsAskedForAndFollowsFromTheSeed) {
  ScanProtocol noisy = without_noise;
  noisy.noise_hu = 20.0;
  const auto scan_with = [&](uint64_t seed) {
    return take_scan([](const Vec3&) { return 50.0; }, field, noisy, seed).hu;
  };
  const std::vector<int16_t> first = scan_with(7);
  const std::vector<double> values(first.begin(), first.end());
  EXPECT_NEAR(statistics::mean_of(values), 50.0, 1.0);
  EXPECT_NEAR(statistics::spread_of(values).sd, 20.0, 0.6);
  EXPECT_EQ(first, scan_with(7));
  EXPECT_NE(first, scan_with(8));
}

TEST(Scanner, WritesItsVoxelsAsTheyAre) {
  const Scan scan{{3, 2, 1}, Vec3(0.5, 0.5, 1.25), Vec3(10.0, 20.0, 30.0), {0, 1, -2, 300, -400, 1200}};
  const test::TemporaryFolder folder;
  write_nrrd(scan, folder.path() / "scan.nrrd");
  std::ifstream file(folder.path() / "scan.nrrd", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  EXPECT_NE(bytes.find("space: left-posterior-superior\nsizes: 3 2 1\n"), std::string::npos);
  // The first voxel's centre.
  EXPECT_NE(bytes.find("space origin: (10.250000,20.250000,30.625000)\n"), std::string::npos);
  const size_t data = bytes.find("\n\n") + 2;
  ASSERT_EQ(bytes.size(), data + 2 * scan.hu.size());
  for (size_t i = 0; i < scan.hu.size(); ++i) {
    const auto low = static_cast<uint8_t>(bytes[data + 2 * i]),
               high = static_cast<uint8_t>(bytes[data + 2 * i + 1]);
    EXPECT_EQ(static_cast<int16_t>(low | high << 8), scan.hu[i]);
  }
}

TEST(PublishedDensity, WorkedByHand) {
  // 1000 HU: (1.3152 + 694.4) / 1000 = 0.6957152; times 0.877 and 0.079 more: 0.6891422; by 0.598: 1.1524118.
  EXPECT_NEAR(published_density_g_cc(1000.0), 1.1524118, 1e-6);
  EXPECT_NEAR(published_hu(1.1524118), 1000.0, 1e-4);
}

TEST(InParallel, DoesEachOnceAndThrowsWhatTheLowestThrew) {
  std::vector<int> done(50);
  in_parallel(done.size(), [&](size_t i) { ++done[i]; });
  EXPECT_EQ(done, std::vector<int>(50, 1));
  try {
    in_parallel(done.size(), [&](size_t i) {
      ++done[i];
      if (i == 11 || i == 40) throw std::runtime_error(std::to_string(i));
    });
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "11");
  }
  EXPECT_EQ(done, std::vector<int>(50, 2)) << "the others are done all the same";
}

}  // namespace
}  // namespace ream::bench
