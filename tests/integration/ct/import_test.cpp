#include "ct/build/import.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "ct/phantom/phantom_case.hpp"
#include "ct/read/read_ct.hpp"
#include "ct/read/write_volume.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "unit/ct/shoulder_phantom.hpp"

namespace ream::ct {
namespace {

namespace fs = std::filesystem;

PhantomPreset small_preset() {
  PhantomPreset preset = phantom_preset("demo");
  preset.params.spacing_mm = Vec3(0.8, 0.75, 1.0);
  return preset;
}

const Phantom& phantom() {
  static const Phantom made = make_phantom(small_preset().params);
  return made;
}

ImportOptions options_in_the_vault() {
  ImportOptions options;
  options.side = case_::Side::right;
  options.segmentation.threshold_hu = small_preset().params.calibration.threshold_hu;
  options.segmentation.seeds.scapula_mm =
      phantom().truth.glenoid.centre_mm - 5.0 * phantom().truth.glenoid.lateral;
  options.build.upsample = 2;
  options.build.around_glenoid = false;
  return options;
}

void expect_same_place(const HuVolume& a, const HuVolume& b, double tolerance_mm) {
  ASSERT_EQ(a.dims, b.dims);
  EXPECT_LT((a.spacing_mm - b.spacing_mm).norm(), tolerance_mm);
  EXPECT_LT((a.world_of_centre(Vec3i::Zero()) - b.world_of_centre(Vec3i::Zero())).norm(), tolerance_mm);
  EXPECT_LT((a.world_of_centre(a.dims) - b.world_of_centre(b.dims)).norm(), tolerance_mm);
}

TEST(VolumeFiles, EveryFormatGivesBackTheVolume) {
  const test::TemporaryFolder folder;
  for (const double turn : {0.0, 0.4}) {
    HuVolume volume = phantom().volume;
    volume.world_from_volume.rotation = rotation_from_small_vector({turn, -0.5 * turn, 0.3 * turn});
    for (const char* name : {"ct.nrrd", "ct.nii.gz", "ct.mha", "ct.nii"}) {
      write_volume_file(volume, folder.path() / name);
      const HuVolume back = read_ct(folder.path() / name);
      EXPECT_EQ(back.hu, volume.hu) << name;
      expect_same_place(back, volume, 1e-3);
    }
    const fs::path series = folder.path() / ("dicom" + std::to_string(turn > 0));
    fs::create_directories(series);
    write_dicom_folder(volume, series, 1);
    const HuVolume back = read_ct(series);
    EXPECT_EQ(back.hu, volume.hu);
    expect_same_place(back, volume, 1e-4);
    EXPECT_TRUE(back.warnings.empty());
  }
}

TEST(VolumeFiles, LeftHandedAxesAreTurnedNotMirrored) {
  const test::TemporaryFolder folder;
  // A 2 x 2 x 3 volume whose third axis points down: a left-handed file.
  const fs::path file = folder.write(
      "ct.nrrd",
      "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 2 2 3\n"
      "space directions: (1,0,0) (0,1,0) (0,0,-2)\nkinds: domain domain domain\n"
      "endian: little\nencoding: ascii\nspace origin: (10,20,30)\n\n1 2 -1 -2 3 4 -3 -4 5 6 -5 -6\n");
  const HuVolume volume = read_ct(file);
  EXPECT_EQ(volume.hu, (std::vector<int16_t>{5, 6, -5, -6, 3, 4, -3, -4, 1, 2, -1, -2}));
  EXPECT_LT((volume.world_of_centre({0, 0, 2}) - Vec3(10, 20, 30)).norm(), 1e-9);
  EXPECT_LT((volume.world_of_centre({0, 0, 0}) - Vec3(10, 20, 26)).norm(), 1e-9);
  EXPECT_TRUE(volume.world_from_volume.rotation.isApprox(Mat3::Identity()));
}

TEST(Import, OfThePhantomIsTheBoneThatGrowsInItsVault) {
  const test::TemporaryFolder folder;
  const case_::Case grown = make_phantom_case("grown", small_preset().params, 2);
  write_dicom_folder(phantom().volume, folder.path(), 1);
  ImportOptions options = options_in_the_vault();
  options.segmentation.fill_holes = false;
  const case_::Case imported = import_ct(folder.path(), "imported", options).made;
  EXPECT_EQ(imported.warnings.size(), 1u) << "only that the volume holds no humeral head";
  const voxel::VoxelGrid &a = imported.bone.grid, &b = grown.bone.grid;
  const Vec3 apart_mm = b.world_from_grid.inverse().point(a.world_from_grid.translation_mm);
  const Vec3i shift = (apart_mm.array() / b.spacing_mm.array()).round().cast<int>().matrix();
  EXPECT_LT((shift.cast<double>().cwiseProduct(b.spacing_mm) - apart_mm).norm(), 1e-4);
  // Where the volume cuts the bone, only what is imported is closed.
  const Vec3i last = 2 * phantom().volume.dims - Vec3i::Constant(4);
  size_t filled = 0, different = 0;
  for (int w = 4; w < last.z(); ++w)
    for (int v = 4; v < last.y(); ++v)
      for (int u = 4; u < last.x(); ++u) {
        const Vec3i there(u, v, w), here = there - shift;
        const int coverage = grown.bone.coverage[b.index(there)];
        filled += coverage >= 128;
        const bool inside = a.contains(here);
        const int of_imported = inside ? imported.bone.coverage[a.index(here)] : 0;
        if (std::max(coverage, of_imported) < 128) continue;
        different += coverage != of_imported || !inside ||
                     grown.bone.density[b.index(there)] != imported.bone.density[a.index(here)];
      }
  EXPECT_GT(filled, 10000u);
  EXPECT_EQ(different, 0u) << "of " << filled;
}

/// As Mimics prints a number: a sign and three digits of exponent.
std::string as_mimics_prints(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%+.8E", value);
  const std::string words = text;
  return words.substr(0, words.size() - 2) + "0" + words.substr(words.size() - 2);
}

TEST(Import, OfRowsAsMimicsWritesThemIsThatOfTheVolume) {
  const test::TemporaryFolder folder;
  const Vec3 centre = phantom().truth.glenoid.centre_mm;
  const HuVolume volume = cropped(phantom().volume, {centre.array() - 9.0, centre.array() + 9.0});
  write_volume_file(volume, folder.path() / "ct.nrrd");
  std::ofstream rows(folder.path() / "ct.txt");
  for (int w = 0; w < volume.dims.z(); ++w)
    for (int v = 0; v < volume.dims.y(); ++v)
      for (int u = 0; u < volume.dims.x(); ++u) {
        const Vec3 at = volume.world_of_centre({u, v, w});
        char gray[20];
        std::snprintf(gray, sizeof gray, ",%+8d\r\n", volume.hu[volume.index(u, v, w)]);
        rows << as_mimics_prints(at.x()) << ", " << as_mimics_prints(at.y()) << ", "
             << as_mimics_prints(at.z()) << gray;
      }
  rows.close();
  const case_::Case from_volume = import_ct(folder.path() / "ct.nrrd", "a", options_in_the_vault()).made;
  const case_::Case from_rows = import_ct(folder.path() / "ct.txt", "b", options_in_the_vault()).made;
  EXPECT_GT(from_rows.bone.filled_voxels(), 1000u);
  EXPECT_EQ(from_rows.bone.grid.dims, from_volume.bone.grid.dims);
  EXPECT_EQ(from_rows.bone.coverage, from_volume.bone.coverage);
  EXPECT_EQ(from_rows.bone.density, from_volume.bone.density);
}

TEST(Import, ALabelMapOfACropTellsTheBone) {
  const test::TemporaryFolder folder;
  HuVolume label = phantom().volume;
  for (int16_t& hu : label.hu) hu = hu >= small_preset().params.calibration.threshold_hu ? 7 : 3;
  const Vec3 centre = phantom().truth.glenoid.centre_mm;
  label = cropped(label, {centre.array() - 14.0, centre.array() + 14.0});
  write_volume_file(phantom().volume, folder.path() / "ct.nrrd");
  write_volume_file(label, folder.path() / "label.nii.gz");
  ImportOptions options = options_in_the_vault();
  options.label = folder.path() / "label.nii.gz";
  options.label_value = 7;
  options.build.upsample = 1;
  const auto set = std::count(label.hu.begin(), label.hu.end(), 7);
  const Imported imported = import_ct(folder.path() / "ct.nrrd", "c", options);
  EXPECT_EQ(std::count(imported.labels.begin(), imported.labels.end(), uint8_t{1}), set);
  EXPECT_GT(imported.made.bone.filled_voxels(), static_cast<size_t>(set) / 2);
  options.label_value = 9;
  test::expect_error(ErrorKind::invalid_input, "value 9",
                     [&] { import_ct(folder.path() / "ct.nrrd", "c", options); });
}

TEST(Import, GridIsWholeBricksAndKeepsTheWorld) {
  const test::TemporaryFolder folder;
  write_volume_file(phantom().volume, folder.path() / "ct.nrrd");
  ImportOptions options = options_in_the_vault();
  const Vec3 centre = phantom().truth.glenoid.centre_mm;
  options.build.roi_mm = Aabb{centre.array() - 9.1, centre.array() + 10.3};
  options.build.upsample = 3;
  const case_::Case c = import_ct(folder.path() / "ct.nrrd", "c", options).made;
  voxel::validate(c.bone.grid);
  const auto hit = case_::surface_along(c.bone, centre, -phantom().truth.glenoid.lateral);
  ASSERT_TRUE(hit);
  EXPECT_LT((*hit - centre).norm(), 0.15);
}

TEST(Import, SaysThatTheSideWasNotGiven) {
  const test::TemporaryFolder folder;
  write_volume_file(phantom().volume, folder.path() / "ct.nrrd");
  ImportOptions options = options_in_the_vault();
  options.side.reset();
  const case_::Case c = import_ct(folder.path() / "ct.nrrd", "c", options).made;
  EXPECT_TRUE(std::any_of(c.warnings.begin(), c.warnings.end(), [](const std::string& warning) {
    return warning.find("--side") != std::string::npos;
  }));
}

TEST(Import, AShoulderIsSegmentedAndItsGlenoidKept) {
  const test::TemporaryFolder folder;
  const PhantomParams params = shoulder_params(case_::Side::left);
  const Phantom left = make_phantom(params);
  write_volume_file(left.volume, folder.path() / "ct.nrrd");
  ImportOptions options;
  options.side = case_::Side::left;
  options.build.upsample = 2;
  options.labels_out = folder.path() / "labels.nii.gz";
  const case_::Case bare = import_ct(folder.path() / "ct.nrrd", "c", options).made;
  EXPECT_TRUE(bare.warnings.empty());
  EXPECT_EQ(bare.side, case_::Side::left);
  EXPECT_EQ(bare.calibration.threshold_hu, suggested_threshold_hu(left.volume));
  const Vec3 size = bare.bone.grid.bounds_mm().max;
  EXPECT_LT(size.maxCoeff(), 80.0);
  const case_::GlenoidFrame& glenoid = left.truth.glenoid;
  const auto hit = case_::surface_along(bare.bone, glenoid.centre_mm, -glenoid.lateral);
  ASSERT_TRUE(hit);
  EXPECT_LT((*hit - glenoid.centre_mm).norm(), 0.5);
  const HuVolume labels = read_volume_file(*options.labels_out);
  EXPECT_EQ(labels.dims, left.volume.dims);
  EXPECT_GT(count_both(std::vector<uint8_t>(labels.hu.begin(), labels.hu.end()), 1,
                       true_labels(left.volume, params), 1),
            10000u);

  options.build.cartilage_mm = 2.0;
  const case_::Case covered = import_ct(folder.path() / "ct.nrrd", "c", options).made;
  const auto top = case_::surface_along(covered.bone, glenoid.centre_mm, -glenoid.lateral);
  ASSERT_TRUE(top);
  EXPECT_NEAR((*top - *hit).dot(glenoid.lateral), 2.0, 0.25);
}

TEST(Import, WhatIsKnownOfTheGlenoidIsNeeded) {
  const test::TemporaryFolder folder;
  write_volume_file(phantom().volume, folder.path() / "ct.nrrd");
  ImportOptions options = options_in_the_vault();
  options.build.around_glenoid = true;
  test::expect_error(ErrorKind::invalid_input, "--glenoid",
                     [&] { import_ct(folder.path() / "ct.nrrd", "c", options); });
  options.glenoid_mm = phantom().truth.glenoid.centre_mm;
  EXPECT_GT(import_ct(folder.path() / "ct.nrrd", "c", options).made.bone.filled_voxels(), 1000u);
}

TEST(Import, BadInputGetsOneClearLine) {
  const test::TemporaryFolder folder;
  const fs::path good = folder.path() / "ct.nrrd";
  write_volume_file(phantom().volume, good);
  const auto refuses = [&](ErrorKind kind, const std::string& words, const fs::path& path,
                           const ImportOptions& options) {
    test::expect_error(kind, words, [&] { import_ct(path, "c", options); });
  };
  const ImportOptions plain = options_in_the_vault();
  refuses(ErrorKind::not_found, "nowhere", folder.path() / "nowhere", plain);
  fs::create_directories(folder.path() / "empty");
  refuses(ErrorKind::invalid_input, "no CT slices", folder.path() / "empty", plain);
  refuses(ErrorKind::invalid_input, "not a volume that can be read", folder.write("notes.doc", "hello"),
          plain);
  refuses(ErrorKind::invalid_input, "notes.txt line 1", folder.write("notes.txt", "hello"), plain);
  for (const char* name : {"ct.nrrd", "ct.nii.gz", "ct.nii", "ct.mha"}) {
    const fs::path file = folder.path() / "short" / name;
    fs::create_directories(file.parent_path());
    write_volume_file(phantom().volume, file);
    fs::resize_file(file, fs::file_size(file) * 2 / 3);
    refuses(ErrorKind::invalid_input, name, file, plain);
    fs::resize_file(file, 10);
    refuses(ErrorKind::invalid_input, name, file, plain);
  }
  ImportOptions options = plain;
  options.build.roi_mm = Aabb{Vec3(1000, 0, 0), Vec3(1010, 10, 10)};
  refuses(ErrorKind::invalid_input, "outside the CT", good, options);
  options = plain;
  options.segmentation.seeds.scapula_mm = phantom().truth.glenoid.centre_mm + Vec3(10, -12, -20);
  refuses(ErrorKind::invalid_input, "seed", good, options);
  options = plain;
  options.segmentation.threshold_hu = 3500;
  refuses(ErrorKind::invalid_input, "3500 HU", good, options);
  options = plain;
  options.label = folder.path() / "no-label.nrrd";
  refuses(ErrorKind::not_found, "no-label.nrrd", good, options);
}

TEST(Import, AHeaderOfZeroVoxelsIsRefused) {
  const test::TemporaryFolder folder;
  const fs::path file =
      folder.write("zero.nrrd",
                   "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 0 1 3\n"
                   "space directions: (1,0,0) (0,1,0) (0,0,1)\nencoding: ascii\nspace origin: (0,0,0)\n\n");
  test::expect_error(ErrorKind::invalid_input, "zero.nrrd", [&] { read_ct(file); });
}

TEST(Import, IdsComeFromFolderNames) {
  EXPECT_EQ(case_id_from("/a/My Shoulder_2/"), "my-shoulder-2");
  EXPECT_EQ(case_id_from("x"), "x");
  EXPECT_EQ(case_id_from("/a/---"), "case");
}

}  // namespace
}  // namespace ream::ct
