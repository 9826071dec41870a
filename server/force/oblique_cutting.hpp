#pragma once
#include <vector>

#include "force/coefficients.hpp"
#include "geometry/vec.hpp"

namespace ream::force {

/// A short piece of a cutting lip. Its point angle epsilon, between lip and tool axis, is that of the tool's
/// meridian at the same radius: tan(epsilon) = dr/dz. For an ellipse that is eq. A.7 with its lost 1/b; like
/// A.7 it takes the slope as if the lip ran straight out from the axis and leaves its offset to the web
/// angle. A lip that lies on the swept surface would have tan(epsilon) = dr/dz / cos(beta): 3 % less torque a
/// thrust.
struct LipElement {
  double radius_mm = 0.0;           ///< of its middle
  double radial_width_mm = 0.0;     ///< dr
  double point_angle_sine = 1.0;    ///< 0 on a wall along the axis
  double point_angle_cosine = 0.0;  ///< 0 on a flat; negative where the surface is hollow
};

/// One of the tool's equal lips: seen along the axis a straight line that passes the axis at `offset_mm`, so
/// no element has a smaller radius. Radii ascend.
struct Lip {
  std::vector<LipElement> elements;
  double offset_mm = 0.0;
};

/// The angles of appendix A at one element as sines and cosines, which stay finite where the angles do not:
/// web beta (A.2), point epsilon, cutting mu (A.10, with the feed per revolution), inclination lambda (A.8),
/// and tau (A.11; its sign, which the arc cosine there loses, comes from the same vectors).
struct CuttingAngles {
  double sin_web, cos_web;
  double sin_point, cos_point;
  double sin_cutting, cos_cutting;
  double sin_inclination, cos_inclination;
  double sin_tau, cos_tau;
};
CuttingAngles cutting_angles(const LipElement& element, double offset_mm, double feed_a_revolution_mm);

/// R of eq. A.12: from x'y'z' (y' along the element's velocity, the edge in the plane of x' and y', z' out of
/// the cut) to machining coordinates (x outwards, y with the rotation, z out of the bone).
Mat3 machining_from_cutting(const CuttingAngles& angles);

/// Directions in x'y'z' of the forces on the rake face (eq. A.9 as corrected), for a normal rake angle: first
/// column across the face, second along it in the direction in which chips flow, which is at lambda from the
/// edge's normal (Stabler). Columns are orthonormal.
using RakeDirections = Eigen::Matrix<double, 3, 2>;
RakeDirections cutting_from_rake(const CuttingAngles& angles, double rake_rad);

/// What one element meets, N and N mm per lip.
struct ElementLoad {
  double radius_mm = 0.0;
  double depth_of_cut_mm = 0.0;  ///< l
  double chip_mm2 = 0.0;         ///< l w, with w the width of cut
  double thrust_n = 0.0;         ///< along the axis, out of the bone positive
  /// Against the rotation positive: radius times the force along y. A.15 as printed takes y' instead, which
  /// leaves out the feed's slope (0.4 % near the axis at 0.2 mm a revolution) and does not keep work.
  double torque_n_mm = 0.0;
};

struct CuttingConditions {
  double feed_a_revolution_mm = 0.0;
  double spindle_rad_s = reference_spindle_rad_s;
  double specific_coefficient_n_mm2 = 1.0;  ///< K of CuttingCoefficients
};

ElementLoad element_load(const LipElement& element, double offset_mm, const CuttingCoefficients& coefficients,
                         const CuttingConditions& conditions);

/// Of one lip, in the order of its elements.
std::vector<ElementLoad> lip_loads(const Lip& lip, const CuttingCoefficients& coefficients,
                                   const CuttingConditions& conditions);

struct LipLoad {
  double thrust_n = 0.0, torque_n_mm = 0.0;
};

/// All lips of the tool together (A.13, A.14).
LipLoad whole_load(const std::vector<ElementLoad>& one_lip);

}  // namespace ream::force
