#include "score/tool_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/units.hpp"

namespace ream::score {
namespace {

/// Moves the apex along x from where it is by a movement of least jerk of so many seconds.
void move(ToolPath& path, double& at_mm, double by_mm, double seconds, bool engaged = false) {
  const int ticks = static_cast<int>(std::lround(seconds * 1000.0));
  const double from_mm = at_mm;
  for (int i = 1; i <= ticks; ++i) {
    const double t = static_cast<double>(i) / ticks;
    at_mm = from_mm + by_mm * t * t * t * (10.0 - 15.0 * t + 6.0 * t * t);
    path.add(Vec3(at_mm, 0.0, 0.0), engaged, false);
  }
}

void rest(ToolPath& path, double at_mm, double seconds) {
  for (int i = 0; i < static_cast<int>(std::lround(seconds * 1000.0)); ++i)
    path.add(Vec3(at_mm, 0.0, 0.0), false, false);
}

TEST(ToolPath, IsAsLongAsTheToolMoved) {
  ToolPath path;
  double at_mm = 0.0;
  move(path, at_mm, 30.0, 1.0);
  move(path, at_mm, -10.0, 1.0);
  move(path, at_mm, 4.0, 2.0, true);
  EXPECT_NEAR(path.in_the_air_mm(), 40.0, 1e-3);
  EXPECT_NEAR(path.in_contact_mm(), 4.0, 1e-9);
}

TEST(ToolPath, PausesAndJumpsAreNoMovement) {
  ToolPath path;
  double at_mm = 0.0;
  move(path, at_mm, 5.0, 0.5);
  path.add(Vec3(500.0, 0.0, 0.0), false, true);
  at_mm = 400.0;
  move(path, at_mm, 5.0, 0.5);
  path.add(Vec3(900.0, 0.0, 0.0), false, false);
  EXPECT_NEAR(path.in_the_air_mm(), 10.0, 1e-3);
}

TEST(Strokes, AreMovementsFromRestToRest) {
  ToolPath path;
  double at_mm = 0.0;
  for (int i = 0; i < 3; ++i) {
    move(path, at_mm, 30.0, 0.8);
    rest(path, at_mm, 0.3);
  }
  EXPECT_EQ(path.strokes().count(), 3);
  // The speed of a movement of least jerk without its slow ends.
  std::vector<double> speed;
  for (int i = 0; i < 80; ++i) {
    const double t = (i + 0.5) / 80.0, mm_s = 30.0 / 0.8 * 30.0 * t * t * (1.0 - t) * (1.0 - t);
    if (mm_s > Strokes::still_mm_s) speed.push_back(mm_s);
  }
  EXPECT_NEAR(*path.strokes().mean_sparc(), *spectral_arc_length(speed, 100.0), 0.02);
  EXPECT_NEAR(*path.strokes().mean_ldlj(), *log_dimensionless_jerk(speed, 100.0), 0.1);
}

TEST(Strokes, AShortStopDoesNotPartThem) {
  ToolPath path;
  double at_mm = 0.0;
  move(path, at_mm, 20.0, 0.6);
  rest(path, at_mm, 0.05);
  move(path, at_mm, 20.0, 0.6);
  rest(path, at_mm, 0.2);
  EXPECT_EQ(path.strokes().count(), 1);
  EXPECT_LT(*path.strokes().mean_sparc(), -1.8);
}

TEST(Strokes, FeedAndShortJerksAreNone) {
  ToolPath path;
  double at_mm = 0.0;
  move(path, at_mm, 0.4, 4.0, true);  // 0.2 mm/s at most
  rest(path, at_mm, 0.2);
  move(path, at_mm, 0.5, 0.1);
  rest(path, at_mm, 0.2);
  EXPECT_EQ(path.strokes().count(), 0);
  EXPECT_FALSE(path.strokes().mean_sparc());
  EXPECT_FALSE(path.strokes().mean_ldlj());
}

TEST(Strokes, OnesThatNeverEndAreParted) {
  Strokes strokes;
  for (int i = 0; i < 95'000; ++i) strokes.add(Vec3(0.01 * i, 0.0, 0.0));
  EXPECT_EQ(strokes.count(), 3);
}

}  // namespace
}  // namespace ream::score
