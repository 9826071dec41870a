#include "force/oblique_cutting.hpp"

#include <algorithm>
#include <cmath>

namespace ream::force {

CuttingAngles cutting_angles(const LipElement& element, double offset_mm, double feed_a_revolution_mm) {
  CuttingAngles a{};
  const double radius = element.radius_mm;
  a.sin_web = offset_mm / radius;
  a.cos_web = std::sqrt(std::max(0.0, (radius - offset_mm) * (radius + offset_mm))) / radius;
  a.sin_point = element.point_angle_sine;
  a.cos_point = element.point_angle_cosine;
  const double turn_mm = 2.0 * pi * radius;
  const double path_mm = std::sqrt(turn_mm * turn_mm + feed_a_revolution_mm * feed_a_revolution_mm);
  a.sin_cutting = feed_a_revolution_mm / path_mm;
  a.cos_cutting = turn_mm / path_mm;
  a.sin_inclination = a.sin_web * a.cos_cutting * a.sin_point + a.sin_cutting * a.cos_point;
  // The edge across its own velocity, outwards and upwards: cos(lambda) cos(tau) and cos(lambda) sin(tau).
  const double outwards = a.sin_point * a.cos_web;
  const double upwards = a.cos_point * a.cos_cutting - a.sin_point * a.sin_web * a.sin_cutting;
  a.cos_inclination = std::sqrt(outwards * outwards + upwards * upwards);
  const bool moves_along_itself = a.cos_inclination == 0.0;
  a.cos_tau = moves_along_itself ? 1.0 : outwards / a.cos_inclination;
  a.sin_tau = moves_along_itself ? 0.0 : upwards / a.cos_inclination;
  return a;
}

Mat3 machining_from_cutting(const CuttingAngles& a) {
  Mat3 r;
  r << a.cos_tau, 0.0, -a.sin_tau,                                          //
      a.sin_tau * a.sin_cutting, a.cos_cutting, a.cos_tau * a.sin_cutting,  //
      a.sin_tau * a.cos_cutting, -a.sin_cutting, a.cos_tau * a.cos_cutting;
  return r;
}

RakeDirections cutting_from_rake(const CuttingAngles& a, double rake_rad) {
  const double sin_rake = std::sin(rake_rad), cos_rake = std::cos(rake_rad);
  const double sin_chip = a.sin_inclination, cos_chip = a.cos_inclination;
  RakeDirections d;
  d << -cos_rake * a.sin_inclination, sin_chip * a.cos_inclination - cos_chip * sin_rake * a.sin_inclination,
      -cos_rake * a.cos_inclination,
      -(cos_chip * sin_rake * a.cos_inclination + sin_chip * a.sin_inclination),  //
      -sin_rake, cos_chip * cos_rake;
  return d;
}

ElementLoad element_load(const LipElement& element, double offset_mm, const CuttingCoefficients& coefficients,
                         const CuttingConditions& conditions) {
  const CuttingAngles a = cutting_angles(element, offset_mm, conditions.feed_a_revolution_mm);
  ElementLoad load;
  load.radius_mm = element.radius_mm;
  const double feed_a_lip_mm = conditions.feed_a_revolution_mm / lip_count;
  load.depth_of_cut_mm = feed_a_lip_mm * a.cos_tau * a.cos_cutting;
  // With w = cos(lambda) dr / (sin(epsilon) cos(beta)), A.11 leaves this of l w, finite at both of lip's
  // ends.
  load.chip_mm2 = feed_a_lip_mm * a.cos_cutting * element.radial_width_mm;

  const double depth = load.depth_of_cut_mm / reference_depth_of_cut_mm;
  const double speed =
      conditions.spindle_rad_s * element.radius_mm / a.cos_cutting / reference_lip_speed_mm_s;
  const double cutting = conditions.specific_coefficient_n_mm2 *
                         std::pow(depth, coefficients.depth_exponent) *
                         std::pow(speed, coefficients.speed_exponent);
  const double friction = coefficients.friction * std::pow(depth, coefficients.friction_depth_exponent) *
                          std::pow(speed, coefficients.friction_speed_exponent);
  const double across_n = cutting * load.chip_mm2, along_n = friction * across_n;
  const Vec3 force_n =
      machining_from_cutting(a) * (cutting_from_rake(a, 0.0) * Eigen::Vector2d(across_n, along_n));
  load.thrust_n = force_n.z();
  load.torque_n_mm = -element.radius_mm * force_n.y();
  return load;
}

std::vector<ElementLoad> lip_loads(const Lip& lip, const CuttingCoefficients& coefficients,
                                   const CuttingConditions& conditions) {
  std::vector<ElementLoad> loads;
  loads.reserve(lip.elements.size());
  for (const LipElement& element : lip.elements)
    loads.push_back(element_load(element, lip.offset_mm, coefficients, conditions));
  return loads;
}

LipLoad whole_load(const std::vector<ElementLoad>& one_lip) {
  LipLoad sum;
  for (const ElementLoad& load : one_lip) {
    sum.thrust_n += lip_count * load.thrust_n;
    sum.torque_n_mm += lip_count * load.torque_n_mm;
  }
  return sum;
}

}  // namespace ream::force
