#include <gtest/gtest.h>

#include "ct/import.hpp"
#include "ct/volume_io.hpp"
#include "support/shared_data.hpp"

namespace ream::ct {
namespace {

const Aabb right_glenoid{{-152, -26, 202}, {-106, 20, 251}};

TEST(SharedCt, DicomFolderAndItsNiftiCropAgree) {
  const auto dicom = test::shared_data("ct/shoulder_dicom"),
             nifti = test::shared_data("ct/shoulder_right_ct.nii.gz");
  REAM_SKIP_WITHOUT(dicom);
  REAM_SKIP_WITHOUT(nifti);
  const HuVolume a = cropped(read_ct(dicom), right_glenoid), b = cropped(read_ct(nifti), right_glenoid);
  ASSERT_EQ(a.dims, b.dims);
  EXPECT_LT((a.world_of_centre(Vec3i::Zero()) - b.world_of_centre(Vec3i::Zero())).norm(), 0.01);
  EXPECT_EQ(a.hu, b.hu);
}

TEST(SharedCt, RightGlenoidImportsAtFullResolution) {
  const auto dicom = test::shared_data("ct/shoulder_dicom"),
             label = test::shared_data("ct/shoulder_right_label.nii.gz");
  REAM_SKIP_WITHOUT(dicom);
  REAM_SKIP_WITHOUT(label);
  ImportOptions options;
  options.roi_mm = right_glenoid;
  options.label = label;
  options.side = case_::Side::right;
  options.segmentation.upsample = 8;
  const case_::Case c = import_ct(dicom, "right", options);
  EXPECT_GE(c.bone.grid.dims.minCoeff(), 300);
  // The face met along its axis, as measured on the label map with a sphere fit.
  const auto entry = case_::surface_along(c.bone, {-133.5, -6.4, 225.6}, {0.706, 0.708, 0});
  ASSERT_TRUE(entry);
  EXPECT_NEAR((*entry - Vec3(-154.87, -27.89, 226.33)).norm(), 33.6, 1.5);
}

TEST(SharedCt, ThickSlicesAreRead) {
  const auto dicom = test::shared_data("ct/shoulder_thick_slices_dicom");
  REAM_SKIP_WITHOUT(dicom);
  const HuVolume volume = read_ct(dicom);
  EXPECT_EQ(volume.dims.z(), 10);
  EXPECT_NEAR(volume.spacing_mm.z(), 8.0, 0.01);
}

}  // namespace
}  // namespace ream::ct
