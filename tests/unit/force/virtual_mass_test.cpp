#include "force/coupling.hpp"

#include <gtest/gtest.h>

#include "core/clock.hpp"

namespace ream::force {
namespace {

Resistance axial(double resistance_n_s_mm) {
  Resistance r;
  r.cutting[14] = resistance_n_s_mm;
  r.outward = -Vec3::UnitZ();
  return r;
}

Vec6 twist_of(const Vec6& motion) {
  Vec6 twist;
  for (size_t i = 0; i < 6; ++i) twist[i] = motion[i] / tick_s;
  return twist;
}

TEST(VirtualMass, FliesAsNewtonSays) {
  VirtualMass mass;
  mass.damping_n_s_mm = 0.0;
  Vec6 twist{};
  double way_mm = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const Vec6 motion = free_flight(mass, twist, {Vec3(0, 0, 4), Vec3::Zero()});
    way_mm += motion[2];
    twist = twist_of(motion);
  }
  // 4 N on 2 kg for a second: 2 m/s, 1 m and half a tick more.
  EXPECT_NEAR(twist[2], 2000.0, 1e-6);
  EXPECT_NEAR(way_mm, 1001.0, 1e-6);
}

TEST(VirtualMass, TurnsAsItsGyrationRadiusSays) {
  VirtualMass mass;
  mass.damping_n_s_mm = 0.0;
  const Vec6 motion = free_flight(mass, {}, {Vec3::Zero(), Vec3(0, 100, 0)});
  EXPECT_NEAR(motion[4] / (tick_s * tick_s), 100.0 * 1000.0 / (2.0 * 50.0 * 50.0), 1e-9);
}

TEST(VirtualMass, DampingGivesATopSpeed) {
  const VirtualMass mass;
  Vec6 twist{};
  for (int i = 0; i < 5000; ++i) twist = twist_of(free_flight(mass, twist, {Vec3(0, 0, 4), Vec3::Zero()}));
  EXPECT_NEAR(twist[2], 4.0 / mass.damping_n_s_mm, 1.0);
}

/// One tick of the coupling with the mass' parameters is one implicit step of M v' = F - B v.
TEST(VirtualMass, CouplingIsTheMassHeldBackByBone) {
  VirtualMass mass;
  mass.damping_n_s_mm = 0.0;
  for (const double b : {0.1, 20.0, 2000.0})
    for (const double speed : {0.0, 3.0, 40.0}) {
      const double force = 52.0;
      const Vec6 way = free_flight(mass, {0, 0, speed, 0, 0, 0}, {Vec3(0, 0, force), Vec3::Zero()});
      const CouplingStep step = couple(coupling_of(mass, 1.0), axial(b), way, tick_s);
      const double m = mass.mass_kg * 1e-3;  // N s^2 / mm
      const double expected = (m * speed / tick_s + force) / (m / tick_s + b);
      EXPECT_NEAR(step.tool_motion[2] / tick_s, expected, 1e-9 * std::max(1.0, expected));
      EXPECT_NEAR(step.wrench_on_tool[2], b * expected, 1e-6 * std::max(1.0, b * expected));
    }
}

TEST(VirtualMass, SettlesAtTheFeedLawAtAnyForceScale) {
  for (const double scale : {1.0, 26.0}) {
    const VirtualMass mass;
    const double b = 2000.0;
    Vec6 twist{};
    CouplingStep step;
    for (int i = 0; i < 100; ++i) {
      const Vec6 way = free_flight(mass, twist, {Vec3(0, 0, 52.0 / scale), Vec3::Zero()});
      step = couple(coupling_of(mass, scale), axial(b), way, tick_s);
      twist = twist_of(step.tool_motion);
    }
    EXPECT_NEAR(twist[2], 0.026, 1e-5);
    EXPECT_NEAR(step.wrench_on_tool[2], 52.0, 0.01);
  }
}

}  // namespace
}  // namespace ream::force
