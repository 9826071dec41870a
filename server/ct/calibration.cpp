#include "ct/calibration.hpp"

#include <algorithm>

namespace ream::ct {
namespace {

constexpr double ash_intercept = 0.079, ash_slope = 0.877, ash_per_apparent = 0.598, mg_per_g = 1000.0;

}  // namespace

double apparent_density_g_cc(double hu, const case_::Calibration& calibration) {
  const double qct = (calibration.intercept_mg_cc + calibration.slope_mg_cc_per_hu * hu) / mg_per_g;
  return std::max(0.0, (ash_intercept + ash_slope * qct) / ash_per_apparent);
}

double hu_of_apparent_density(double density_g_cc, const case_::Calibration& calibration) {
  const double qct = (density_g_cc * ash_per_apparent - ash_intercept) / ash_slope;
  return (qct * mg_per_g - calibration.intercept_mg_cc) / calibration.slope_mg_cc_per_hu;
}

}  // namespace ream::ct
