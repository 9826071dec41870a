#include "ct/segment/label_map.hpp"

#include <gtest/gtest.h>

#include "ct/read/write_volume.hpp"
#include "reader/ct_files.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "unit/ct/shoulder_phantom.hpp"

namespace ream::ct {
namespace {

TEST(LabelMap, ComesBackAsItWasWritten) {
  const test::TemporaryFolder folder;
  HuVolume volume = make_phantom(shoulder_params(case_::Side::right)).volume;
  volume.world_from_volume.rotation = rotation_from_small_vector({0.2, -0.1, 0.3});
  Segmentation labels;
  labels.labels = true_labels(make_phantom(shoulder_params(case_::Side::right)).volume,
                              shoulder_params(case_::Side::right));
  for (const char* name : {"labels.nrrd", "labels.nii.gz"}) {
    write_label_map(volume, labels.labels, folder.path() / name);
    const HuVolume map = reader::read_volume_file(folder.path() / name);
    EXPECT_EQ(map.dims, volume.dims);
    const Segmentation back = segmentation_from_labels(volume, map);
    EXPECT_EQ(back.labels, labels.labels) << name;
    ASSERT_EQ(back.parts.size(), 2u);
    EXPECT_EQ(back.parts[0].label, BoneLabel::scapula);
    EXPECT_EQ(back.parts[0].voxels, count_both(back.labels, 1, back.labels, 1));
  }
}

TEST(LabelMap, ValuesOfTheUsersChoosing) {
  HuVolume volume;
  volume.dims = {4, 1, 1};
  volume.hu.assign(4, 500);
  HuVolume map = volume;
  map.hu = {0, 7, 1, 9};
  LabelValues values;
  values.scapula = 7, values.humerus = 9, values.clavicle = 8;
  EXPECT_EQ(segmentation_from_labels(volume, map, values).labels, (std::vector<uint8_t>{0, 1, 4, 2}));
  values.scapula = 5;
  test::expect_error(ErrorKind::invalid_input, "value 5",
                     [&] { segmentation_from_labels(volume, map, values); });
}

TEST(LabelMap, OtherFilesAreRefused) {
  const test::TemporaryFolder folder;
  HuVolume volume;
  volume.dims = {2, 2, 2};
  volume.hu.assign(8, 0);
  test::expect_error(ErrorKind::invalid_input, ".nrrd",
                     [&] { write_label_map(volume, std::vector<uint8_t>(8), folder.path() / "labels.png"); });
  test::expect_error(ErrorKind::invalid_input, "one label per voxel",
                     [&] { write_label_map(volume, {1}, folder.path() / "labels.nrrd"); });
  for (const char* name : {"labels.nrrd", "labels.nii.gz"})
    test::expect_error(ErrorKind::io, "nowhere", [&] {
      write_label_map(volume, std::vector<uint8_t>(8), folder.path() / "nowhere" / name);
    });
}

}  // namespace
}  // namespace ream::ct
