#pragma once
#include <Eigen/Geometry>
#include <cmath>

#include "case/landmarks.hpp"
#include "case/measures.hpp"
#include "core/units.hpp"

namespace ream::test {

/// Landmarks of a shoulder whose face has exactly these angles (degrees), by rotations written
/// down here: a right one, whose mirror image in x = 0 a left one is.
struct ShoulderShape {
  case_::Side side = case_::Side::right;
  double version_deg = -5.0, inclination_deg = 4.0;
  double plane_deg = 30.0;  ///< of the scapula, turned anterior from the coronal plane
  double height_mm = 37.0, width_mm = 25.0, head_posterior_mm = 0.0;
};

inline case_::Landmarks shoulder_landmarks(const ShoulderShape& shape) {
  const double turn = radians_from_degrees(shape.plane_deg);
  const Vec3 lateral(-std::cos(turn), -std::sin(turn), 0.0), superior(0.0, 0.0, 1.0),
      posterior(-std::sin(turn), std::cos(turn), 0.0);
  const Vec3 centre(-140.0, -20.0, 35.0);
  const double v = radians_from_degrees(shape.version_deg), i = radians_from_degrees(shape.inclination_deg);
  // version = -atan2(n.posterior, n.lateral), inclination = atan2(n.superior, n.lateral)
  const Vec3 normal = (lateral + std::tan(i) * superior - std::tan(v) * posterior).normalized();
  const Vec3 up = (superior - superior.dot(normal) * normal).normalized();
  Vec3 back = normal.cross(up);
  if (back.dot(posterior) < 0.0) back = -back;
  case_::Landmarks l;
  l.glenoid_centre_mm = centre;
  l.superior_rim_mm = centre + 0.5 * shape.height_mm * up;
  l.inferior_rim_mm = centre - 0.5 * shape.height_mm * up;
  l.anterior_rim_mm = centre - 0.5 * shape.width_mm * back;
  l.posterior_rim_mm = centre + 0.5 * shape.width_mm * back;
  l.trigonum_mm = centre - 104.0 * lateral;
  l.inferior_angle_mm = centre - 86.0 * lateral - 107.0 * superior;
  l.humeral_head = case_::HumeralHead{centre + 27.0 * normal + shape.head_posterior_mm * back, 24.0};
  if (shape.side == case_::Side::left) {
    const auto mirror = [](Vec3& p) { p.x() = -p.x(); };
    for (auto* p : {&l.glenoid_centre_mm, &l.superior_rim_mm, &l.inferior_rim_mm, &l.anterior_rim_mm,
                    &l.posterior_rim_mm, &l.trigonum_mm, &l.inferior_angle_mm})
      mirror(**p);
    mirror(l.humeral_head->centre_mm);
  }
  return l;
}

}  // namespace ream::test
