#include "force/guide.hpp"
#include "support/seed.hpp"

#include <gtest/gtest.h>

#include <random>

namespace ream::force {
namespace {

struct Problem {
  GuideWalls walls;
  AxisSideways wanted;
};

Problem random_problem(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0), share(0.0, 1.0);
  Problem p;
  p.walls.leading_mm = 8.0 * share(random);
  p.walls.trailing_mm = p.walls.leading_mm - 0.05 - 30.0 * share(random) * share(random);
  p.walls.clearance_mm = 0.02 + share(random);
  p.walls.angular_per_linear_mm2 = 200.0 + 3000.0 * share(random);
  const double reach = 3.0 * share(random) * share(random), tilt = 0.3 * share(random) * share(random);
  p.wanted.origin_mm = {reach * unit(random), reach * unit(random)};
  p.wanted.slope = {tilt * unit(random), tilt * unit(random)};
  return p;
}

double energy(const Problem& p, const AxisSideways& axis) {
  return (axis.origin_mm - p.wanted.origin_mm).squaredNorm() +
         p.walls.angular_per_linear_mm2 * (axis.slope - p.wanted.slope).squaredNorm();
}

Vec2 leading(const Problem& p, const AxisSideways& a) { return a.origin_mm + p.walls.leading_mm * a.slope; }
Vec2 trailing(const Problem& p, const AxisSideways& a) { return a.origin_mm + p.walls.trailing_mm * a.slope; }

TEST(GuideWalls, KeepBothPointsWithinTheClearance) {
  std::mt19937 random(test::seed(20260401));
  int touched = 0;
  for (int i = 0; i < 20000; ++i) {
    const Problem p = random_problem(random);
    const BetweenWalls found = between_walls(p.walls, p.wanted);
    EXPECT_LE(leading(p, found.axis).norm(), p.walls.clearance_mm + 1e-7) << "seed 20260401, problem " << i;
    EXPECT_LE(trailing(p, found.axis).norm(), p.walls.clearance_mm + 1e-7) << "seed 20260401, problem " << i;
    if (!found.free) ++touched;
    if (!found.free) continue;
    EXPECT_EQ(found.axis.origin_mm, p.wanted.origin_mm);
    EXPECT_EQ(found.axis.slope, p.wanted.slope);
  }
  EXPECT_GT(touched, 5000);
}

TEST(GuideWalls, NoAxisBetweenTheWallsIsNearer) {
  // The condition of the nearest point of a convex set: towards any point of it the distance grows.
  std::mt19937 random(test::seed(7));
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 5000; ++i) {
    const Problem p = random_problem(random);
    const AxisSideways found = between_walls(p.walls, p.wanted).axis;
    for (int k = 0; k < 20; ++k) {
      Vec2 a(unit(random), unit(random)), b(unit(random), unit(random));
      a *= p.walls.clearance_mm / std::max(1.0, a.norm());
      b *= p.walls.clearance_mm / std::max(1.0, b.norm());
      AxisSideways other;
      other.slope = (a - b) / (p.walls.leading_mm - p.walls.trailing_mm);
      other.origin_mm = a - p.walls.leading_mm * other.slope;
      const double towards =
          (p.wanted.origin_mm - found.origin_mm).dot(other.origin_mm - found.origin_mm) +
          p.walls.angular_per_linear_mm2 * (p.wanted.slope - found.slope).dot(other.slope - found.slope);
      EXPECT_LE(towards, 1e-7 * (1.0 + energy(p, found) + energy(p, other))) << "seed 7, problem " << i;
    }
  }
}

TEST(GuideWalls, NearWishesHaveNearAnswers) {
  std::mt19937 random(test::seed(11));
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 5000; ++i) {
    const Problem a = random_problem(random);
    Problem b = a;
    b.wanted.origin_mm += 0.1 * Vec2(unit(random), unit(random));
    b.wanted.slope += 0.01 * Vec2(unit(random), unit(random));
    const AxisSideways fa = between_walls(a.walls, a.wanted).axis, fb = between_walls(b.walls, b.wanted).axis;
    Problem answers = a;
    answers.wanted = fa;
    EXPECT_LE(energy(answers, fb), energy(a, b.wanted) * (1.0 + 1e-6) + 1e-9) << "seed 11, problem " << i;
  }
}

TEST(GuideWalls, AnswersAreLeftAsTheyAre) {
  std::mt19937 random(test::seed(13));
  for (int i = 0; i < 5000; ++i) {
    const Problem p = random_problem(random);
    const AxisSideways once = between_walls(p.walls, p.wanted).axis;
    const AxisSideways twice = between_walls(p.walls, once).axis;
    EXPECT_LE((twice.origin_mm - once.origin_mm).norm(), 1e-7) << "seed 13, problem " << i;
    EXPECT_LE((twice.slope - once.slope).norm(), 1e-7) << "seed 13, problem " << i;
  }
}

TEST(GuideWalls, PureTiltIsHalvedBetweenThem) {
  // Symmetric about the middle of the guided length: slope 2 c / L, the middle stays on the guide's axis.
  const GuideWalls walls{4.0, -4.0, 0.1, 1000.0};
  const BetweenWalls found = between_walls(walls, {Vec2::Zero(), Vec2(0.1, 0.0)});
  EXPECT_NEAR(found.axis.slope.x(), 2.0 * 0.1 / 8.0, 1e-12);
  EXPECT_NEAR(found.axis.origin_mm.norm(), 0.0, 1e-12);
  // Couple of the pushes: 8 mm x push = 1000 mm2 x slope taken back.
  EXPECT_NEAR(found.trailing_push_mm.x(), 1000.0 * (0.1 - 0.025) / 8.0, 1e-9);
}

}  // namespace
}  // namespace ream::force
