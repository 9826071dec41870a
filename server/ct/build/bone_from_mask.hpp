#pragma once
#include <array>
#include <optional>

#include "case/case.hpp"
#include "core/progress.hpp"
#include "ct/segment/mask.hpp"

namespace ream::ct {

/// Density chain with the laws of the case: rho_QCT = intercept + slope HU; rho_ash =
/// intercept + slope rho_QCT; apparent density = rho_ash / ratio, all g/cc. Negative results become 0.
double apparent_density_g_cc(double hu, const case_::Calibration& calibration);

/// Its inverse: the HU that a bone of that apparent density has.
double hu_of_apparent_density(double density_g_cc, const case_::Calibration& calibration);

/// HU that partial volume at the surface is measured against: muscle and joint fluid.
inline constexpr double soft_tissue_hu = 40.0;

/// What makes a mask over a CT a bone to ream.
struct BoneSettings {
  std::optional<Aabb> roi_mm;  ///< world (LPS); without it the box around the mask
  int upsample = 1;            ///< 1 to 16 per axis
  case_::Calibration calibration;
};

/// Bone of a mask over a CT: voids filled; at the surface, how full a voxel is follows from its HU between
/// soft tissue and the densest bone beside it (so the surface is sub-voxel and thin sheets survive;
/// blur of 0.75, 1, 1.5 and 2 CT voxels SD puts it 0.2, 0.5, 1 and 2 of them outside, as the bone beside is
/// not yet whole), and density is that of the bone within, not of the mix; both upsampled
/// (voxel/upsample.hpp) and padded to whole bricks; then the surface is redrawn as a ramp about a voxel
/// wide, 1.5 where it was upsampled (surface_ramp.hpp). Only the part of the mask within the region of
/// interest, with an empty CT voxel on every side so that the surface is closed where the region cuts the
/// bone. Throws Error invalid_input for an empty mask, no bone within the region, a bad factor, or more
/// than 1.5e9 voxels.
voxel::BoneModel bone_from_mask(const HuVolume& volume, const Mask& mask, const BoneSettings& settings,
                                const Progress& progress);
/// The same over the grid of the whole volume, open where the volume cuts the bone.
voxel::BoneModel bone_of_whole_volume(const HuVolume& volume, Mask mask, int upsample,
                                      const case_::Calibration& calibration);

/// Region of interest around a glenoid: a box along the world's axes of 60 mm across, 60 mm front to back and
/// 70 mm high, about a point 15 mm medial of the centre (`lateral` need not be a unit vector).
Aabb glenoid_roi_mm(const Vec3& centre_mm, const Vec3& lateral);

/// Least and greatest density (g/cc) of the bone's voxels that are at least half full, cartilage left out;
/// the bytes of any model range from 0 to 2.50 g/cc in steps of 0.01. Zeros for an empty bone.
std::array<double, 2> density_range_g_cc(const voxel::BoneModel& bone);

}  // namespace ream::ct
