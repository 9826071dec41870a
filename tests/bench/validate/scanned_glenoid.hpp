#pragma once
#include "bench/validate/scanner.hpp"
#include "support/analytic_glenoid.hpp"
#include "voxel/bone_model.hpp"

namespace ream::bench {

/// HU of muscle, joint fluid and cartilage, which CT without contrast hardly tells apart.
inline constexpr double soft_tissue_hu = 50.0;

/// A shoulder by formulas: a glenoid, and 4 mm before it a humeral head (24 mm, a shell of 1 mm of 1.2 g/cc
/// about 0.35 g/cc).
struct ScannedGlenoid {
  test::AnalyticGlenoid glenoid;
  ScanProtocol protocol;
  int upsample = 2;  ///< of the import
  uint64_t seed = 1;
};

/// Its bone by the way that a user goes: a scan as a NRRD file, imported with a click in the scapula and one
/// in the humeral head, all else as the program has it by itself. Errors: those of ct::import_ct.
voxel::BoneModel imported_bone(const ScannedGlenoid& scanned);

/// A file imported whole with these clicks, world mm.
voxel::BoneModel imported_bone(const Scan& scan, case_::Side side, const Vec3& in_scapula_mm,
                               const std::optional<Vec3>& in_humerus_mm, int upsample);

}  // namespace ream::bench
