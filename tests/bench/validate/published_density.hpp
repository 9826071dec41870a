#pragma once

namespace ream::bench {

/// From HU to density as published, typed in: rho_ash = 0.079 + 0.877 rho_QCT and rho_ash = 0.598 of the
/// apparent density, g/cc (Schileo 2008, J Biomech 41:2483). Every scanner has its own rho_QCT; that of the
/// program's example is 1.3152 mg/cc + 0.6944 mg/cc for each HU.
inline constexpr double published_ash_intercept_g_cc = 0.079, published_ash_slope = 0.877,
                        published_ash_per_apparent = 0.598;
inline constexpr double example_qct_intercept_mg_cc = 1.3152, example_qct_slope_mg_cc_per_hu = 0.6944;

inline double published_density_g_cc(double hu) {
  const double qct_g_cc = (example_qct_intercept_mg_cc + example_qct_slope_mg_cc_per_hu * hu) / 1000.0;
  return (published_ash_intercept_g_cc + published_ash_slope * qct_g_cc) / published_ash_per_apparent;
}

/// Its inverse.
inline double published_hu(double apparent_g_cc) {
  const double qct_g_cc =
      (published_ash_per_apparent * apparent_g_cc - published_ash_intercept_g_cc) / published_ash_slope;
  return (1000.0 * qct_g_cc - example_qct_intercept_mg_cc) / example_qct_slope_mg_cc_per_hu;
}

/// Subchondral plate of glenoids: 1.9 mm (Frich 1998), 1.2 to 2.9.
inline constexpr double published_plate_mm = 1.9;

}  // namespace ream::bench
