#include "ct/calibration.hpp"

#include <algorithm>

namespace ream::ct {
namespace {

constexpr double mg_per_g = 1000.0;

}  // namespace

double apparent_density_g_cc(double hu, const case_::Calibration& calibration) {
  const double qct = (calibration.intercept_mg_cc + calibration.slope_mg_cc_per_hu * hu) / mg_per_g;
  const double ash = calibration.ash_intercept_g_cc + calibration.ash_slope * qct;
  return std::max(0.0, ash / calibration.ash_per_apparent);
}

double hu_of_apparent_density(double density_g_cc, const case_::Calibration& calibration) {
  const double ash = density_g_cc * calibration.ash_per_apparent;
  const double qct = (ash - calibration.ash_intercept_g_cc) / calibration.ash_slope;
  return (qct * mg_per_g - calibration.intercept_mg_cc) / calibration.slope_mg_cc_per_hu;
}

}  // namespace ream::ct
