#pragma once
#include <string>
#include <vector>

#include "record/tick_report.hpp"
#include "support/cutting_body.hpp"
#include "voxel/bone_model.hpp"

namespace ream::test {

/// What a voxel-by-voxel comparison of a reamed bone with the swept body found.
struct SweptTally {
  size_t voxels = 0;       ///< of the grid
  size_t bone_before = 0;  ///< had coverage before the first tick
  size_t must_be_gone =
      0;  ///< centre inside the swept body by more than half a voxel, 1/64 voxel and tolerance
  size_t must_be_kept = 0;  ///< centre outside by more than half a voxel and tolerance
  size_t at_surface = 0;    ///< between the two: coverage held against the distance
  size_t not_gone = 0, not_kept = 0, off_at_surface = 0;  ///< wrong
  size_t grown = 0;                                       ///< wrong: more coverage than before
  int64_t levels_removed = 0;                             ///< 1/255 voxel
  double removed_mm3 = 0.0;
  /// Farthest a kept voxel lies inside the swept body and a changed one outside, mm (from -+ half a voxel
  /// on).
  double deepest_kept_mm = 0.0, farthest_changed_mm = 0.0;
  size_t poses = 0, settled_poses = 0;

  size_t wrong() const { return not_gone + not_kept + off_at_surface + grown; }
  std::string text() const;
};

/// Compares every voxel with the body swept over the poses at which the tool cut, a
/// pose for every 1/64 voxel of motion. Expected coverage falls from 255 half a voxel (smallest edge) outside
/// to 0 half a voxel inside; the tool may have moved 1/64 voxel since the last look, and `tolerance_mm` is
/// allowed for the body itself. Bone must be gone where the tool went on cutting until every brick near it
/// had its turn, and whole where it never cut. `before`: coverage after the pilot hole and before the first
/// tick.
SweptTally compare_with_sweep(const voxel::BoneModel& bone, const std::vector<uint8_t>& before,
                              const CuttingBody& body, const std::vector<record::TickReport>& reports,
                              double tolerance_mm);

/// Coverage levels that the ticks say they removed.
int64_t reported_levels(const std::vector<record::TickReport>& reports);

}  // namespace ream::test
