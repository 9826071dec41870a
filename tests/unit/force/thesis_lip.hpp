#pragma once
#include <cmath>

#include "force/oblique_cutting.hpp"

namespace ream::test {

inline constexpr double ellipse_a_mm = 18.25, ellipse_b_mm = 9.0;

inline double thesis_offset_mm() { return ellipse_a_mm * std::sin(force::lip_angle_rad); }

/// Element of the ellipse's lip; its point angle from the ellipse, not from a profile.
inline force::LipElement ellipse_element(double radius_mm, double radial_width_mm) {
  const double out = ellipse_a_mm * std::sqrt((ellipse_a_mm - radius_mm) * (ellipse_a_mm + radius_mm));
  const double up = ellipse_b_mm * radius_mm;
  const double length = std::sqrt(out * out + up * up);
  return {radius_mm, radial_width_mm, out / length, up / length};
}

/// The lip of the thesis' reamer (18.25 and 9 mm) in elements of equal length as seen along the axis.
inline force::Lip thesis_lip(int count) {
  force::Lip lip;
  lip.offset_mm = thesis_offset_mm();
  const double offset2 = lip.offset_mm * lip.offset_mm;
  const double length = std::sqrt(ellipse_a_mm * ellipse_a_mm - offset2);
  double inner = lip.offset_mm;
  for (int i = 1; i <= count; ++i) {
    const double along = length * i / count;
    const double outer = i == count ? ellipse_a_mm : std::sqrt(along * along + offset2);
    lip.elements.push_back(ellipse_element(0.5 * (inner + outer), outer - inner));
    inner = outer;
  }
  return lip;
}

}  // namespace ream::test
