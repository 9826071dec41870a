#pragma once
#include <cstdint>
#include <vector>

#include "case/landmarks.hpp"
#include "core/progress.hpp"
#include "ct/workup.hpp"

namespace ream::ct {

/// The segmented scapula at the CT's own resolution with sub-voxel surface, in a grid about its bounding box.
/// Throws Error conflict when the segmentation holds no scapula.
voxel::BoneModel scapula_of(const Workup& workup, const std::vector<int16_t>& hu,
                            const std::vector<uint8_t>& labels);

/// The case that comes out: scapula cropped, upsampled and, where asked, covered with cartilage; with the
/// glenoid frame and the ROI that was taken in `workup.built`. Errors: conflict without a segmentation, or
/// naming the landmarks that are missing (glenoid centre for the ROI, rim points for cartilage);
/// invalid_input for too many voxels.
case_::Case build_from(Workup& workup, const std::vector<int16_t>& hu, const std::vector<uint8_t>& labels,
                       const case_::Landmarks& landmarks, const BuildSettings& settings,
                       const Progress& progress);

/// What ct.json says of a bone that was built.
BuildRecord build_record(const voxel::BoneModel& bone, const BuildSettings& settings,
                         int segmentation_revision);

}  // namespace ream::ct
