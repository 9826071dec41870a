#pragma once
#include "case/case.hpp"

namespace ream::ct {

/// A layer of cartilage that CT does not show. Means of 1.9 to 2.2 mm are reported for glenoids, more below
/// and less in the middle.
struct CartilageSettings {
  double thickness_mm = 2.0;  ///< along the face's normal, 0 (none) to 6
  double rim_taper_mm = 1.5;  ///< it thins to nothing over this width at the rim, 0 to 10
  double reach_mm = 24.0;     ///< nothing farther than this from the glenoid's centre, along the face
};

/// Lays cartilage on the articular face: what is met first, within 10 mm of the centre, on going medially
/// (against `lateral`) and belongs to the same sheet as the centre; the sheet ends at the rim, where it turns
/// by more than 55 degrees off `lateral`. New voxels have voxel::cartilage_code and sub-voxel coverage;
/// voxels that were bone at least by half keep their density and are filled up to the layer, so that there is
/// no gap. Thickness 0 changes nothing. Returns how many voxels are cartilage. Throws Error invalid_input for
/// settings out of range or no bone under the centre.
size_t add_cartilage(voxel::BoneModel& bone, const case_::GlenoidFrame& glenoid,
                     const CartilageSettings& settings);

}  // namespace ream::ct
