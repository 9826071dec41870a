#pragma once
#include "core/units.hpp"

namespace ream::force {

/// Thrust of the cadaver experiments at which the feed laws were fitted, N (thesis 5.1).
inline constexpr double reference_thrust_n = 52.0;

/// Feed rate at the reference thrust: f = slope * D + intercept, f in mm/s, D in g/cc.
struct FeedLaw {
  double slope_mm_s_per_g_cc;
  double intercept_mm_s;
};
inline constexpr FeedLaw cortical_feed_law{-0.05, 0.11};    ///< thesis eq. 5.1, fitted for 1.30 to 1.61 g/cc
inline constexpr FeedLaw cancellous_feed_law{-0.34, 0.42};  ///< thesis eq. 5.2, fitted for 0.41 to 0.72 g/cc

/// Cartilage was cut away before the experiments; it yields at least as fast as the softest cancellous bone
/// there (0.28 mm/s). Engineering choice.
inline constexpr double cartilage_feed_mm_s = 0.40;

/// The laws reach zero inside the density range (2.20 and 1.235 g/cc); no bone is slower than this at the
/// reference thrust. Engineering choice, mm/s.
inline constexpr double min_feed_mm_s = 0.005;

/// Simulated thrust below which the lips only rub, N. Engineering choice.
inline constexpr double start_threshold_n = 1.0;

/// Spindle speed of the experiments, rpm (thesis 5.1).
inline constexpr double reference_spindle_rpm = 156.0;
inline constexpr double reference_spindle_rad_s = rad_s_from_rpm(reference_spindle_rpm);

/// Cutting lips of the reamer (thesis, appendix A.1).
inline constexpr int lip_count = 5;

/// The angle alpha of eq. A.1: lips pass the axis at this part of the cutting radius, a sin(alpha), which is
/// 3.0 mm of the thesis' 18.25 mm (appendix A.1.1). Kept for tools of other sizes: engineering choice.
inline constexpr double lip_angle_rad = radians_from_degrees(9.46);

/// Specific cutting coefficient kc and friction coefficient kf of eq. 1.1 as the power laws of eq. 1.2, each
/// about a reference so that what stands before the power keeps its unit:
///   kc = K        (l / l_0)^depth_exponent          (V / V_0)^speed_exponent,           K in N/mm^2
///   kf = friction (l / l_0)^friction_depth_exponent (V / V_0)^friction_speed_exponent
/// with l the depth of cut and V the speed of the lip. K follows from the feed law (kc is calibrated so that
/// the whole lip takes 52 N at f(D)). The rake term of eq. 1.2 is 1, as the rake is 0. The thesis measured no
/// coefficient, so all of these are engineering choices.
struct CuttingCoefficients {
  /// Ratio of the forces along and across the rake face, 0.2 to 1: wet bone on steel, lips half sharp. Thrust
  /// comes mostly from it as the rake is 0; below about 0.15 the lips would pull themselves in.
  double friction = 0.5;
  /// -0.9 to 0.9. 0 keeps thrust all but proportional to feed, as the feed law does; metals have -0.3 to 0.
  double depth_exponent = 0.0;
  /// -0.9 to 0.9. 0: at one feed per revolution the forces do not know the speed.
  double speed_exponent = 0.0;
  double friction_depth_exponent = 0.0;  ///< -0.9 to 0.9
  double friction_speed_exponent = 0.0;  ///< -0.9 to 0.9

  // Of EdgeFeedModel (edge_load.hpp):
  /// Edge that was engaged in the thesis' experiments, mm, above 0: its reamer (appendix A) wholly in contact
  /// with a face of 37.5 x 24.4 mm, counted down to the axis. Its true contact is unknown; specific energies
  /// of drilling say 7 to 25.
  double edge_reference_mm = 70.5;
  /// phi, 0 to below 1: part of the load that is there however thin the chip. The thesis saw feed grow about
  /// linearly with thrust (5.2), which is 0; single saw teeth have 0.6 to 0.9.
  double edge_threshold_share = 0.0;
  /// mu_c: load along the lips' path over the load along the surface's normal. Torque of drills in human bone
  /// over thrust and radius says 1.0 to 1.2 (MacAvelia 2012); range 0.5 to 1.8.
  double tangential_ratio = 1.0;
};

/// Where the power laws are 1: depth of cut (0.05 mm a revolution on five lips) in mm, and speed of a lip
/// 10 mm off the axis of the thesis' spindle, in mm/s.
inline constexpr double reference_depth_of_cut_mm = 0.01;
inline constexpr double reference_lip_speed_mm_s = 10.0 * reference_spindle_rad_s;

}  // namespace ream::force
