#include "score/cut_axis.hpp"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/units.hpp"
#include "support/seed.hpp"

namespace ream::score {
namespace {

Pose tilted(double tilt_x_deg, double tilt_y_deg, const Vec3& apex_mm) {
  const Vec3 turn(radians_from_degrees(tilt_x_deg), radians_from_degrees(tilt_y_deg), 0.0);
  return {rotation_from_small_vector(turn), apex_mm};
}

TEST(CutAxis, IsNotThereBeforeSomethingIsRemoved) {
  CutAxis axis;
  axis.add(tilted(3.0, 0.0, Vec3(0, 0, 1.0)), 0);
  EXPECT_FALSE(axis.line());
}

TEST(CutAxis, IsTheToolsLineOfAStraightPlunge) {
  CutAxis axis;
  const Pose at_entry = tilted(6.0, -4.0, Vec3(1.5, -0.7, 0.0));
  const Vec3 direction = at_entry.rotation.col(2);
  Vec3 apex_mm = at_entry.translation_mm;
  for (int i = 0; i < 3000; ++i, apex_mm += 0.0007 * direction)
    axis.add({at_entry.rotation, apex_mm}, 10 + i % 7);
  const CutLine line = axis.line().value();
  EXPECT_NEAR((line.direction - direction).norm(), 0.0, 1e-12);
  EXPECT_NEAR((line.apex_mm - at_entry.translation_mm).cross(direction).norm(), 0.0, 1e-9);
  EXPECT_NEAR((line.deepest_apex_mm() - (apex_mm - 0.0007 * direction)).norm(), 0.0, 1e-9);
}

/// The definition once more, over all ticks at once.
TEST(CutAxis, IsTheMeanWeightedByVolumeOverTheLastHalfMillimetre) {
  std::mt19937 random(test::seed(31));
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::uniform_int_distribution<int64_t> weight(0, 50);
  for (int round = 0; round < 20; ++round) {
    CutAxis axis;
    std::vector<std::pair<Pose, int64_t>> ticks;
    double z_mm = number(random);
    for (int i = 0; i < 2000; ++i) {
      z_mm += 0.004 * (number(random) + 0.2);
      ticks.emplace_back(tilted(8.0 * number(random), 8.0 * number(random), Vec3(0, 0, z_mm)),
                         weight(random));
      axis.add(ticks.back().first, ticks.back().second);
    }
    double deepest_mm = -1e9;
    for (const auto& [pose, removed] : ticks)
      if (removed > 0) deepest_mm = std::max(deepest_mm, pose.translation_mm.z());
    Vec3 sum = Vec3::Zero();
    for (const auto& [pose, removed] : ticks)
      if (pose.translation_mm.z() > deepest_mm - 0.5)
        sum += static_cast<double>(removed) * pose.rotation.col(2);
    const Vec3 direction = axis.line().value().direction;
    EXPECT_LT(degrees_from_radians(std::acos(std::min(1.0, direction.dot(sum.normalized())))), 0.1) << round;
    EXPECT_EQ(axis.line()->deepest_mm, deepest_mm);
  }
}

TEST(CutAxis, WhatWasRemovedHigherUpIsForgotten) {
  CutAxis axis;
  for (int i = 0; i < 100; ++i) axis.add(tilted(20.0, 0.0, Vec3(0, 0, 0.01 * i)), 1000);
  for (int i = 0; i < 60; ++i) axis.add(tilted(0.0, 0.0, Vec3(0, 0, 1.0 + 0.01 * i)), 1);
  EXPECT_NEAR((axis.line()->direction - Vec3::UnitZ()).norm(), 0.0, 1e-12);
  // A deep leap leaves nothing of what was before; a shallow cut afterwards does not count.
  axis.add(tilted(10.0, 0.0, Vec3(0, 0, 9.0)), 1);
  axis.add(tilted(-30.0, 0.0, Vec3(0, 0, -5.0)), 1000);
  EXPECT_NEAR((axis.line()->direction - tilted(10.0, 0.0, Vec3::Zero()).rotation.col(2)).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace ream::score
