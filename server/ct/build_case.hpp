#pragma once
#include <optional>

#include "case/case.hpp"
#include "ct/segment.hpp"

namespace ream::ct {

/// What turns a CT into bone. Points are world (LPS) mm.
struct SegmentationOptions {
  double sigma_mm = 0.0;             ///< Gaussian before the threshold
  double threshold_hu = 200.0;       ///< bone is at least this
  std::optional<Vec3> grow_from_mm;  ///< part to keep; without it, the largest part
  int upsample = 1;                  ///< 1 to 16 per axis
  case_::Calibration calibration;    ///< its threshold_hu is set from threshold_hu
};

/// HU that partial volume at the surface is measured against: muscle and joint fluid.
inline constexpr double soft_tissue_hu = 40.0;

/// Mask by threshold and region growing. `volume` is smoothed in place first. Throws Error invalid_input when
/// nothing reaches the threshold or no bone lies within 2 mm of the seed.
Mask segment(HuVolume& volume, const SegmentationOptions& options);

/// Bone of a mask over a CT: voids filled; at the surface, how full a voxel is follows from its HU between
/// soft tissue and the densest bone beside it (so the surface is sub-voxel and thin sheets survive), and
/// density is that of the bone within, not of the mix; both upsampled (voxel/upsample.hpp) and padded to
/// whole bricks.
voxel::BoneModel bone_from_mask(const HuVolume& volume, Mask mask, const SegmentationOptions& options);

}  // namespace ream::ct
