#pragma once
#include "case/case.hpp"

namespace ream::ct {

/// Density chain of science 2.5 with the laws of the case: rho_QCT = intercept + slope HU; rho_ash =
/// intercept + slope rho_QCT; apparent density = rho_ash / ratio, all g/cc. Negative results become 0.
double apparent_density_g_cc(double hu, const case_::Calibration& calibration);

/// Its inverse: the HU that a bone of that apparent density has.
double hu_of_apparent_density(double density_g_cc, const case_::Calibration& calibration);

}  // namespace ream::ct
