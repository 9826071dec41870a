#pragma once
#include "case/case.hpp"

namespace ream::ct {

/// Density chain of science 2.5: rho_QCT = intercept + slope HU; rho_ash = 0.079 + 0.877 rho_QCT (Schileo
/// 2008); apparent density = rho_ash / 0.598, all g/cc. Negative results become 0.
double apparent_density_g_cc(double hu, const case_::Calibration& calibration);

/// Its inverse: the HU that a bone of that apparent density has.
double hu_of_apparent_density(double density_g_cc, const case_::Calibration& calibration);

}  // namespace ream::ct
