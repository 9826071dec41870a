#include "score/path_economy.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "core/units.hpp"
#include "support/seed.hpp"

namespace ream::score {
namespace {

/// One tick of a path whose planned axis is z.
struct PathTick {
  Vec3 apex_mm = Vec3::Zero();
  bool engaged = false, removing = false, paused = false;
};

/// Contact and whole, percent; each empty where it is missing.
struct Economy {
  std::optional<double> in_contact, whole;
};

Economy economy_of(const std::vector<PathTick>& ticks) {
  PathEconomy economy;
  for (const PathTick& tick : ticks) {
    record::TickReport r;
    r.engaged = tick.engaged;
    r.paused = tick.paused;
    r.coverage_removed[0] = tick.removing ? 7 : 0;
    economy.add(r, tick.apex_mm, tick.apex_mm.z());
  }
  MetricResults results;
  economy.write(results);
  return {results.value("path_economy_contact_percent"), results.value("path_economy_percent")};
}

/// Goes on in a straight line, in steps of 0.01 mm.
void go_to(std::vector<PathTick>& ticks, const Vec3& to, bool engaged, bool removing) {
  const Vec3 from = ticks.empty() ? to : ticks.back().apex_mm;
  const int steps = std::max(1, static_cast<int>((to - from).norm() / 0.01));
  for (int i = 1; i <= steps; ++i)
    ticks.push_back({from + (to - from) * (1.0 * i / steps), engaged, removing});
}

TEST(PathEconomy, StraightInAndStraightOutIsAllThatIsNeeded) {
  std::vector<PathTick> ticks;
  go_to(ticks, Vec3(5, 0, -20), false, false);
  go_to(ticks, Vec3(0, 0, 0), false, false);
  go_to(ticks, Vec3(0, 0, 3), true, true);
  go_to(ticks, Vec3(2, 1, -15), false, false);
  const Economy e = economy_of(ticks);
  EXPECT_NEAR(*e.in_contact, 100.0, 1e-6);
  // From aside: two straight lines by way of the entry instead of one to the deepest place.
  const double needed = Vec3(5, 0, -23).norm() + Vec3(2, 1, -18).norm();
  EXPECT_NEAR(*e.whole, 100.0 * needed / (Vec3(5, 0, -20).norm() + 3.0 + Vec3(2, 1, -18).norm()), 1e-6);
}

TEST(PathEconomy, AZigzagOfSixtyDegreesIsHalfOfIt) {
  std::vector<PathTick> ticks;
  go_to(ticks, Vec3(0, 0, 0), true, true);
  const double aside = std::tan(radians_from_degrees(60.0));
  for (int i = 1; i <= 10; ++i) go_to(ticks, Vec3(i % 2 == 0 ? 0.0 : aside, 0, i), true, true);
  EXPECT_NEAR(*economy_of(ticks).in_contact, 50.0, 1e-6);
  EXPECT_NEAR(*economy_of(ticks).whole, 50.0, 1e-6);
}

TEST(PathEconomy, WhatIsNotCutIsNotJudged) {
  std::vector<PathTick> ticks;
  EXPECT_FALSE(economy_of(ticks).whole);
  go_to(ticks, Vec3(0, 0, 0), false, false);
  go_to(ticks, Vec3(0, 0, 5), true, false);
  EXPECT_FALSE(economy_of(ticks).in_contact);
  EXPECT_FALSE(economy_of(ticks).whole);
}

TEST(PathEconomy, APauseTakesNothingAwayAndAddsNothing) {
  std::vector<PathTick> ticks;
  go_to(ticks, Vec3(0, 0, -4), false, false);
  go_to(ticks, Vec3(0, 0, 2), true, true);
  ticks.push_back({Vec3(0, 0, 2), true, false, true});
  ticks.push_back({Vec3(30, 0, -9), false, false, true});
  ticks.push_back({Vec3(30, 0, -9), false});
  go_to(ticks, Vec3(0, 0, -4), false, false);
  const Economy e = economy_of(ticks);
  EXPECT_NEAR(*e.in_contact, 100.0, 1e-6);
  EXPECT_NEAR(*e.whole, 100.0, 1e-6);
}

/// The same by what the definition says, from the list of all ticks, stretch by stretch.
Economy reference_of(const std::vector<PathTick>& ticks) {
  double path = 0.0, shortest = 0.0, contact = 0.0, gained = 0.0;
  bool any_removed = false;
  double deepest_contact = -1e9;
  bool touched = false;
  for (size_t begin = 0; begin < ticks.size();) {
    if (ticks[begin].paused) {
      ++begin;
      continue;
    }
    size_t end = begin + 1;
    while (end < ticks.size() && !ticks[end].paused &&
           (ticks[end].apex_mm - ticks[end - 1].apex_mm).norm() <= 1.0)
      ++end;
    std::optional<Vec3> deepest;
    for (size_t i = begin; i < end; ++i) {
      const Vec3& at = ticks[i].apex_mm;
      if (ticks[i].removing && (!deepest || at.z() > deepest->z())) deepest = at;
      if (i > begin) path += (at - ticks[i - 1].apex_mm).norm();
      if (!ticks[i].engaged) continue;
      if (i > begin) {
        contact += (at - ticks[i - 1].apex_mm).norm();
        const double before = ticks[i - 1].apex_mm.z();
        const double from = touched ? std::max(deepest_contact, before) : before;
        if (at.z() > from) gained += at.z() - from;
      }
      touched = true;
      deepest_contact = std::max(deepest_contact, at.z());
    }
    const Vec3 first = ticks[begin].apex_mm, last = ticks[end - 1].apex_mm;
    shortest += deepest ? (*deepest - first).norm() + (last - *deepest).norm() : (last - first).norm();
    any_removed = any_removed || deepest;
    begin = end;
  }
  if (!any_removed) return {};
  return {contact > 0.0 ? std::optional(100.0 * gained / contact) : std::nullopt, 100.0 * shortest / path};
}

/// A hand that wanders, touches, cuts, pauses and jumps by chance.
std::vector<PathTick> random_path(std::mt19937& random) {
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 8) / static_cast<double>(1u << 24);
  };
  std::vector<PathTick> ticks;
  Vec3 at(between(-5, 5), between(-5, 5), between(-9, -3)), speed = Vec3::Zero();
  bool paused = false;
  for (int i = 0; i < 4000; ++i) {
    for (int axis = 0; axis < 3; ++axis) speed[axis] = 0.98 * speed[axis] + between(-0.01, 0.01);
    if (random() % 400 == 0) paused = !paused;
    if (random() % 900 == 0) at += Vec3(2.0, 0.5, -1.0);
    at += speed;
    const bool engaged = at.z() > -1.0;
    ticks.push_back({at, engaged, engaged && random() % 3 == 0, paused});
  }
  return ticks;
}

TEST(PathEconomy, IsThatOfTheListOfAllTicksAndNeverOverOneHundred) {
  const unsigned seed = test::seed(71);
  int judged = 0;
  for (unsigned n = 0; n < 50; ++n) {
    std::mt19937 random(seed + n);
    const auto ticks = random_path(random);
    const Economy said = economy_of(ticks), truth = reference_of(ticks);
    ASSERT_EQ(said.whole.has_value(), truth.whole.has_value());
    if (!truth.whole) continue;
    ++judged;
    EXPECT_NEAR(*said.whole, *truth.whole, 1e-5);
    EXPECT_NEAR(*said.in_contact, *truth.in_contact, 1e-5);
    for (const double percent : {*said.whole, *said.in_contact}) {
      EXPECT_GE(percent, 0.0);
      EXPECT_LE(percent, 100.0);
    }
    // Turned about the planned axis and moved along with the bone, it is the same.
    auto turned = ticks;
    for (PathTick& tick : turned)
      tick.apex_mm = Eigen::AngleAxisd(1.1, Vec3::UnitZ()) * tick.apex_mm + Vec3(3, -4, 5);
    EXPECT_NEAR(*economy_of(turned).whole, *said.whole, 1e-5);
    EXPECT_NEAR(*economy_of(turned).in_contact, *said.in_contact, 1e-5);
  }
  EXPECT_GT(judged, 20);
}

}  // namespace
}  // namespace ream::score
