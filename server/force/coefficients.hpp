#pragma once

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
/// reference thrust. Engineering choice (science.md finding 3), mm/s.
inline constexpr double slowest_feed_mm_s = 0.005;

/// Simulated thrust below which the lips only rub, N. Engineering choice.
inline constexpr double start_threshold_n = 1.0;

/// Spindle speed of the experiments, rpm (thesis 5.1).
inline constexpr double reference_spindle_rpm = 156.0;

}  // namespace ream::force
