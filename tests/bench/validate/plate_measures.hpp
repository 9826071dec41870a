#pragma once
#include "support/analytic_glenoid.hpp"
#include "voxel/bone_model.hpp"

namespace ream::bench {

/// What is said of a subchondral plate that was reamed straight down the face's normal by a sphere of 22 mm
/// within 10 mm of the axis, 0.3 mm deeper than planned.
struct PlateMeasures {
  double thickness_mm = 0.0, preserved_percent = 0.0, planned_percent = 0.0, lost_percent = 0.0;
};

/// The planned depth: 0.3 mm deeper half of the plate is gone from half of the component's footprint, which
/// is where the share preserved depends on depth most.
double reamed_depth_mm(const test::AnalyticGlenoid& glenoid);

/// By the formulas of the glenoid alone, integrated over a lattice of 0.1 mm.
PlateMeasures true_plate(const test::AnalyticGlenoid& glenoid);

/// By the program's metrics, on a bone from which the same reamer is taken by its distance.
PlateMeasures measured_plate(const test::AnalyticGlenoid& glenoid, const voxel::BoneModel& bone);

}  // namespace ream::bench
