#include "force/heat.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ream::force {
namespace {

/// Ream's law by other means, for comparison: even cells, small explicit steps, SI units, degrees Celsius.
class EvenBone {
 public:
  EvenBone(double k_w_m_k, double c_j_m3_k) : k_(k_w_m_k), c_(c_j_m3_k), t_c_(300, 35.0) {}

  void run(double seconds, double flux_w_m2, double speed_m_s, double film_w_m2_k = 0.0) {
    constexpr double dt = 1e-2;
    const int steps = static_cast<int>(std::lround(seconds / dt));
    std::vector<double> next(t_c_.size());
    for (int step = 0; step < steps; ++step) {
      // The surface's temperature by the gradient over the first half cell.
      const double into =
          (flux_w_m2 + film_w_m2_k * (22.0 - t_c_[0])) / (1.0 + film_w_m2_k * dx / (2.0 * k_));
      surface_c_ = t_c_[0] + into * dx / (2.0 * k_);
      for (size_t i = 0; i < t_c_.size(); ++i) {
        const double below = i + 1 < t_c_.size() ? t_c_[i + 1] : 35.0;
        const double from_above = i == 0 ? into : k_ * (t_c_[i - 1] - t_c_[i]) / dx;
        const double above = i == 0 ? surface_c_ : t_c_[i - 1];
        // Central differences, at the surface over a cell and a half.
        const double slope = i == 0 ? (below - above) / (1.5 * dx) : (below - above) / (2.0 * dx);
        next[i] =
            t_c_[i] + dt / c_ * ((from_above + k_ * (below - t_c_[i]) / dx) / dx + c_ * speed_m_s * slope);
      }
      t_c_.swap(next);
      reached_m_ = std::max(reached_m_ - speed_m_s * dt, depth_over(56.0));
    }
  }

  double surface_c() const { return surface_c_; }
  double dead_mm() const { return 1e3 * reached_m_; }

 private:
  static constexpr double dx = 0.1e-3;

  double depth_over(double limit_c) const {
    if (surface_c_ < limit_c) {
      const auto hot = std::find_if(t_c_.rbegin(), t_c_.rend(), [&](double t) { return t >= limit_c; });
      if (hot == t_c_.rend()) return 0.0;
    }
    for (size_t i = t_c_.size() - 1; i > 0; --i)
      if (t_c_[i - 1] >= limit_c)
        return dx * (static_cast<double>(i) - 0.5 + (t_c_[i - 1] - limit_c) / (t_c_[i - 1] - t_c_[i]));
    return t_c_[0] >= limit_c ? dx / 2.0 : 0.0;
  }

  double k_, c_, surface_c_ = 35.0, reached_m_ = 0.0;
  std::vector<double> t_c_;
};

HeatSettings bone_of(double k_w_m_k, double c_mj_m3_k) {
  HeatSettings bone;
  bone.conductivity_w_m_k = k_w_m_k;
  bone.heat_capacity_mj_m3_k = c_mj_m3_k;
  return bone;
}

constexpr double step_s = 0.01;

void run(HeatColumn& column, const HeatSettings& bone, double seconds, const HeatSurface& surface,
         double speed_mm_s) {
  for (int i = 0; i < static_cast<int>(std::lround(seconds / step_s)); ++i)
    column.step(bone, surface, speed_mm_s * step_s, step_s);
}

/// What somebody else computed of a reaming, depths in steps of 0.2 mm.
struct Row {
  double flux_kw_m2, k, c, film_w_m2_k, seconds, surface_c, dead_mm;
};

constexpr Row table[] = {
    {5, 0.55, 2.3, 0, 20, 55, 0.0},  {5, 0.55, 2.3, 0, 40, 62, 0.8},  {5, 0.55, 2.3, 0, 60, 67, 1.6},
    {8, 0.55, 2.3, 0, 20, 67, 1.0},  {8, 0.55, 2.3, 0, 40, 78, 2.2},  {8, 0.55, 2.3, 0, 60, 86, 3.2},
    {12, 0.55, 2.3, 0, 20, 83, 2.0}, {12, 0.55, 2.3, 0, 40, 99, 3.6}, {12, 0.55, 2.3, 0, 60, 111, 5.0},
    {8, 0.35, 3.0, 0, 20, 69, 0.8},  {8, 0.35, 3.0, 0, 40, 79, 1.6},  {8, 0.35, 3.0, 0, 60, 86, 2.2},
    {8, 0.45, 2.6, 300, 40, 44, 0.0}};

TEST(Heat, AgreesWithTheTableAndWithAnotherProgram) {
  for (const Row& row : table) {
    HeatColumn column;
    const HeatSettings bone = bone_of(row.k, row.c);
    const HeatSurface wet{0.0, row.film_w_m2_k * 1e-6, 22.0 - 35.0};
    HeatSurface cut = wet;
    cut.flux_w_mm2 = row.flux_kw_m2 * 1e-3;
    run(column, bone, row.seconds, cut, 0.03);
    EvenBone other(row.k, 1e6 * row.c);
    other.run(row.seconds, 1e3 * row.flux_kw_m2, 3e-5, row.film_w_m2_k);
    EXPECT_NEAR(35.0 + column.surface_k(), row.surface_c, 2.0) << row.flux_kw_m2 << ' ' << row.seconds;
    EXPECT_NEAR(35.0 + column.surface_k(), other.surface_c(), 0.5) << row.flux_kw_m2 << ' ' << row.seconds;
    run(column, bone, 20.0, wet, 0.0);
    other.run(20.0, 0.0, 0.0, row.film_w_m2_k);
    EXPECT_NEAR(column.dead_depth_mm(), row.dead_mm, 0.25) << row.flux_kw_m2 << ' ' << row.seconds;
    EXPECT_NEAR(column.dead_depth_mm(), other.dead_mm(), 0.05) << row.flux_kw_m2 << ' ' << row.seconds;
  }
}

TEST(Heat, AStandingSurfaceWarmsAsTheHalfSpaceDoes) {
  // 2 q sqrt(t / (pi k rho c)), SI units; at depth x by the integral of the complementary error function.
  constexpr double q = 6000.0, k = 0.5, c = 2.6e6;
  HeatColumn column;
  double passed_s = 0.0;
  for (const double t : {1.0, 5.0, 20.0, 60.0}) {
    run(column, bone_of(0.5, 2.6), t - passed_s, {6e-3, 0.0, 0.0}, 0.0);
    passed_s = t;
    const double pi_ = std::acos(-1.0), at_surface_k = 2.0 * q * std::sqrt(t / (pi_ * k * c));
    EXPECT_NEAR(column.surface_k(), at_surface_k, 0.01 * at_surface_k) << t;
    double top_mm = 0.0;
    for (size_t i = 0; i < HeatColumn::cells && top_mm < 8.0; ++i) {
      const double x = 1e-3 * (top_mm + 0.5 * HeatColumn::width_mm(i)), spread = 2.0 * std::sqrt(k / c * t);
      const double there_k =
          q / k *
          (spread / std::sqrt(pi_) * std::exp(-x * x / (spread * spread)) - x * std::erfc(x / spread));
      EXPECT_NEAR(column.excess_k(i), there_k, 0.015 * at_surface_k) << t << " s, " << top_mm << " mm";
      top_mm += HeatColumn::width_mm(i);
    }
  }
}

TEST(Heat, ASteadyCutEndsWhereChipsCarryAllHeatAway) {
  HeatColumn column;
  run(column, bone_of(0.5, 2.6), 60.0, {20e-3, 0.0, 0.0}, 0.3);
  const double expected_k = 20e3 / (2.6e6 * 0.3e-3);
  EXPECT_NEAR(column.excess_k(0), expected_k, 0.01 * expected_k)
      << "what leaves is as warm as the first cell";
  EXPECT_NEAR(column.surface_k(), expected_k, 1.0);
}

double stored_j_mm2(const HeatColumn& column, double c_mj_m3_k) {
  double sum = 0.0;
  for (size_t i = 0; i < HeatColumn::cells; ++i)
    sum += 1e-3 * c_mj_m3_k * HeatColumn::width_mm(i) * column.excess_k(i);
  return sum;
}

TEST(Heat, NothingIsLostButInChipsAndToSaline) {
  HeatColumn column;
  const HeatSettings bone = bone_of(0.4, 2.8);
  double in_j = 0.0, chips_j = 0.0, saline_j = 0.0;
  for (int i = 0; i < 9000; ++i) {
    HeatSurface surface{i % 3000 < 2000 ? 9e-3 : 0.0, i > 4000 ? 3e-4 : 0.0, -13.0};
    const double advance_mm = i % 500 < 300 ? 4e-4 : 0.0;
    column.step(bone, surface, advance_mm, step_s);
    in_j += surface.flux_w_mm2 * step_s;
    chips_j += 2.8e-3 * advance_mm * column.excess_k(0);
    saline_j += surface.film_w_mm2_k * (column.surface_k() + 13.0) * step_s;
    ASSERT_NEAR(stored_j_mm2(column, 2.8), in_j - chips_j - saline_j, 1e-9) << i;
  }
  EXPECT_GT(chips_j, 0.05 * in_j);
  EXPECT_GT(saline_j, 0.05 * in_j);
}

TEST(Heat, DeadBoneThatIsReamedAwayNoLongerCounts) {
  HeatColumn column;
  const HeatSettings bone;
  run(column, bone, 40.0, {12e-3, 0.0, 0.0}, 0.03);
  run(column, bone, 60.0, {}, 0.0);
  const double dead_mm = column.dead_depth_mm();
  EXPECT_GT(dead_mm, 2.0);
  run(column, bone, 10.0, {}, 0.1);
  EXPECT_NEAR(column.dead_depth_mm(), dead_mm - 1.0, 1e-9);
  run(column, bone, 60.0, {}, 0.1);
  EXPECT_EQ(column.dead_depth_mm(), 0.0);
}

TEST(Heat, TheProfileFollowsFromTheSurfaceAlone) {
  // So that a recording, which has surface and feed, tells how deep bone died.
  HeatColumn made, found;
  const HeatSettings bone;
  for (int i = 0; i < 6000; ++i) {
    const double advance_mm = i % 700 < 500 ? 3e-4 : 0.0;
    made.step(bone, {i % 1500 < 1100 ? 11e-3 : 0.0, i > 4500 ? 3e-4 : 0.0, -13.0}, advance_mm, step_s);
    found.step(bone, {0.0, holding_film_w_mm2_k, made.surface_k()}, advance_mm, step_s);
    ASSERT_NEAR(found.dead_depth_mm(), made.dead_depth_mm(), 0.01) << i;
  }
  EXPECT_GT(made.dead_depth_mm(), 0.5);
}

/// A second of ticks.
void work(HeatedBone& heated, double seconds, const HeatTick& tick) {
  for (int i = 0; i < static_cast<int>(1000 * seconds); ++i) heated.add({}, tick);
}

/// Torque that grows with thrust from 0.48 N m at 52 N on 685 mm2.
HeatTick seated(double thrust_n, double rpm, bool irrigated) {
  HeatTick tick;
  tick.power_w = 0.48 * thrust_n / 52.0 * rpm * 2.0 * std::acos(-1.0) / 60.0;
  tick.area_mm2 = 685.0;
  tick.advance_mm = 0.03 * thrust_n / 52.0 * rpm / 156.0 * 1e-3;
  tick.irrigated = irrigated;
  return tick;
}

struct Reaming {
  double thrust_n, rpm, seconds;
};
constexpr Reaming five[] = {{52, 156, 60}, {52, 200, 50}, {65, 200, 50}, {75, 156, 60}, {80, 250, 40}};

TEST(Heat, DryReamingKillsBoneAndIrrigationSavesIt) {
  const HeatSettings settings;
  int over = 0;
  std::vector<double> dead_mm;
  for (const Reaming& reaming : five) {
    HeatedBone dry, wet;
    work(dry, reaming.seconds, seated(reaming.thrust_n, reaming.rpm, false));
    work(wet, reaming.seconds, seated(reaming.thrust_n, reaming.rpm, true));
    over += dry.surface_c(settings) > 56.0;
    EXPECT_LT(wet.surface_c(settings), 56.0) << reaming.thrust_n;
    EXPECT_EQ(wet.column().dead_depth_mm(), 0.0) << reaming.thrust_n;
    const double surface_c = dry.surface_c(settings);
    work(dry, 20.0, {});
    dead_mm.push_back(dry.column().dead_depth_mm());
    std::cout << reaming.thrust_n << " N, " << reaming.rpm << " rpm, " << reaming.seconds
              << " s: " << surface_c << " C dry, " << wet.surface_c(settings) << " C irrigated, 56 C to "
              << dead_mm.back() << " mm\n";
  }
  EXPECT_GE(over, 4);
  std::sort(dead_mm.begin(), dead_mm.end());
  EXPECT_GT(dead_mm[2], 1.0);
  EXPECT_LT(dead_mm.back(), 5.2);
}

TEST(Heat, ASmallContactIsHotButNotEndlesslySo) {
  HeatTick rim = seated(20.0, 156.0, false);
  double before_k = 0.0;
  for (const double area_mm2 : {400.0, 100.0, 50.0, 1.0, 1e-3}) {
    rim.area_mm2 = area_mm2;
    HeatedBone heated;
    work(heated, 10.0, rim);
    EXPECT_LT(heated.column().surface_k(), 150.0);
    if (area_mm2 < 50.0)
      EXPECT_EQ(heated.column().surface_k(), before_k);
    else
      EXPECT_GT(heated.column().surface_k(), before_k);
    before_k = heated.column().surface_k();
  }
}

TEST(Heat, BoneStaysWarmUnderALiftedToolAndIsColdElsewhere) {
  const HeatSettings settings;
  const HeatTick cut = seated(52.0, 156.0, false);
  HeatedBone heated;
  work(heated, 20.0, cut);
  const double hot_c = heated.surface_c(settings);
  work(heated, 1.0, {});
  const double cooled_c = heated.surface_c(settings);
  EXPECT_LT(cooled_c, hot_c - 2.0);
  EXPECT_GT(cooled_c, 40.0);
  HeatTick near = cut;
  near.apex_mm = Vec3(3.0, 0.0, 5.0);
  work(heated, 0.5, near);
  EXPECT_GT(heated.surface_c(settings), cooled_c) << "the same place, deeper";
  HeatTick far = cut;
  far.apex_mm = Vec3(0.0, 16.0, 0.0);
  heated.add(settings, far);
  EXPECT_EQ(heated.surface_c(settings), 35.0);
}

TEST(Heat, UntouchedBoneStaysAtBodyTemperatureToTheLastBit) {
  HeatedBone heated;
  work(heated, 5.0, {});
  EXPECT_EQ(heated.surface_c({}), 35.0);
  HeatTick rinsed;
  rinsed.irrigated = true;
  work(heated, 30.0, rinsed);
  EXPECT_EQ(heated.surface_c({}), 35.0) << "saline in the air cools no bone";
}

}  // namespace
}  // namespace ream::force
