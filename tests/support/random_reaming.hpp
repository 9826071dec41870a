#pragma once
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "core/units.hpp"
#include "support/reaming_truth.hpp"

namespace ream::test {

/// A reaming to be run: what a robot does with a glenoid.
struct RandomReaming : PlannedReaming {
  nlohmann::json script;
};

/// Side, version, inclination, curvature, plan, reamer, implant, hole, entry, tilt and depth by chance.
inline RandomReaming random_reaming(unsigned seed, double voxel_mm) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 8) / static_cast<double>(1u << 24);
  };
  RandomReaming r;
  ShoulderShape& shoulder = r.glenoid.shoulder;
  shoulder.side = seed % 2 == 0 ? case_::Side::right : case_::Side::left;
  shoulder.version_deg = between(-12.0, 6.0);
  shoulder.inclination_deg = between(-4.0, 12.0);
  shoulder.height_mm = between(30.0, 36.0);
  shoulder.width_mm = between(22.0, 27.0);
  r.glenoid.radius_mm = between(30.0, 42.0);
  // Bone that a robot gets through without hurry in simulated seconds.
  r.glenoid.compact_g_cc = 1.2;
  r.glenoid.spongy_g_cc = 0.8;

  const AnalyticGlenoid::Frame face = r.glenoid.frame();
  const double tilt = radians_from_degrees(between(0.0, 6.0)), way = between(0.0, 2.0 * pi);
  r.plan.axis_direction = r.glenoid.mirrored(
      -(face.n + std::tan(tilt) * (std::cos(way) * face.superior + std::sin(way) * face.anterior))
           .normalized());
  const Vec3 aside = between(-1.5, 1.5) * face.superior + between(-1.5, 1.5) * face.anterior;
  const double radius = r.glenoid.radius_mm;
  r.plan.entry_mm =
      r.glenoid.mirrored(face.centre + radius * face.n + radius * (aside - radius * face.n).normalized());
  r.plan.depth_mm = between(1.6, 3.2);

  const bool round = random() % 3 != 0;
  r.reamer.across_mm = round ? between(26.0, 40.0) : between(10.0, 13.0);
  r.reamer.along_mm = round ? r.reamer.across_mm : 0.5 * r.reamer.across_mm;
  r.reamer.outer_mm = round ? between(9.0, 13.0) : r.reamer.across_mm;
  const bool guided = random() % 3 == 0, hole = guided || random() % 2 == 0;
  if (guided) r.reamer.nipple_mm = 3.0;
  r.plan.pilot_hole.reset();
  if (hole) r.plan.pilot_hole = case_::PilotHole{6.4, 12.0};
  r.plan.reamer = r.reamer.words();
  if (round && random() % 2 == 0) r.plan.implant_radius_mm = r.reamer.across_mm + between(-3.0, 6.0);
  r.pilot_margin_mm = voxel_mm;

  const double off = guided ? 0.0 : 1.0;
  r.script = {{"device", "robot"},
              {"duration_s", 60.0},
              {"specimen_factor", 6.0},
              {"vibration", {{"source", "off"}}},
              {"robot",
               {{"start_mm", {off * between(-1.5, 1.5), off * between(-1.5, 1.5), -5.0}},
                {"tilt_deg", {off * between(-5.0, 5.0), off * between(-5.0, 5.0), 0.0}},
                {"approach_mm_s", 10.0},
                {"force_n", 50.0},
                {"ramp_s", 0.3},
                {"depth_mm", r.plan.depth_mm + off * between(-0.2, 0.2)}}}};
  return r;
}

}  // namespace ream::test
