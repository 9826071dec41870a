#pragma once
#include "support/analytic_glenoid.hpp"
#include "voxel/bone_model.hpp"

namespace ream::bench {

/// What an import makes of a glenoid's tissues, by where the formulas have them; densities are means of
/// voxels that are bone, g/cc.
struct DensityMeasures {
  double plate_g_cc = 0.0;  ///< within 0.25 mm of the middle of the subchondral plate
  double shell_g_cc = 0.0;  ///< the same of the shell around the vault
  double core_g_cc = 0.0;   ///< spongy bone 3 mm and more from all compact bone
  double core_deviation_g_cc = 0.0;
  double joint_bone_percent = 0.0;  ///< of the space 1 to 3 mm before the face: taken for bone
  double surface_mm = 0.0;          ///< mean place of the face, positive outside of where it is
};

DensityMeasures measured_density(const test::AnalyticGlenoid& glenoid, const voxel::BoneModel& bone);

}  // namespace ream::bench
