#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include <Eigen/LU>
#include "ct/read/write_volume.hpp"
#include "reader/ct_files.hpp"
#include "reader/dicom_file.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"
#include "support/temporary_folder.hpp"
#include "unit/reader/changed_dicom.hpp"

namespace ream::reader {
using namespace ct;
namespace {

namespace fs = std::filesystem;
using test::mentions, test::slice_file;

/// HU as a linear function of the place, which linear resampling gives back but for rounding.
double field(const Vec3& p) { return 3.0 * p.x() - 2.0 * p.y() + 5.0 * p.z(); }

/// A series whose slice i lies at `places[i]` (centre of the first pixel), all of one orientation.
void write_series(const fs::path& folder, const std::vector<Vec3>& places, const Mat3& rotation,
                  uint64_t seed = 1) {
  HuVolume volume;
  volume.dims = {32, 28, static_cast<int>(places.size())};
  volume.spacing_mm = {0.8, 0.7, 1.0};
  volume.world_from_volume.rotation = rotation;
  for (const Vec3& place : places)
    for (int v = 0; v < 28; ++v)
      for (int u = 0; u < 32; ++u)
        volume.hu.push_back(static_cast<int16_t>(
            std::floor(field(place + rotation.col(0) * (0.8 * u) + rotation.col(1) * (0.7 * v)) + 0.5)));
  write_dicom_folder(volume, folder, seed);
  for (size_t i = 0; i < places.size(); ++i) {
    char text[96];
    std::snprintf(text, sizeof text, "%.9g\\%.9g\\%.9g", places[i].x(), places[i].y(), places[i].z());
    test::set_text(slice_file(folder, static_cast<int>(i) + 1), 0x0020, 0x0032, text);
  }
}

std::vector<Vec3> up(const std::vector<double>& heights) {
  std::vector<Vec3> places;
  for (const double z : heights) places.emplace_back(-10.0, -8.0, z);
  return places;
}

/// Voxels that hold the field, and how many must.
void expect_field(const HuVolume& volume, double tolerance_hu, double share_at_least) {
  size_t right = 0;
  for (int w = 0; w < volume.dims.z(); ++w)
    for (int v = 0; v < volume.dims.y(); ++v)
      for (int u = 0; u < volume.dims.x(); ++u)
        right += std::abs(volume.hu[volume.index(u, v, w)] - field(volume.world_of_centre({u, v, w}))) <=
                 tolerance_hu;
  EXPECT_GE(static_cast<double>(right), share_at_least * static_cast<double>(volume.voxel_count()));
}

TEST(DicomRepairs, ATiltedGantryIsResampledOnAnOrthogonalGrid) {
  for (const double tilt_deg : {-18.0, 12.0}) {
    const test::TemporaryFolder folder;
    const double t = tilt_deg * M_PI / 180.0;
    Mat3 rotation;  // rows along x, columns tilted; the table moves along z all the same
    rotation << 1, 0, 0, 0, std::cos(t), -std::sin(t), 0, std::sin(t), std::cos(t);
    std::vector<double> heights;
    for (int i = 0; i < 12; ++i) heights.push_back(1.5 * i);
    write_series(folder.path(), up(heights), rotation);
    const HuVolume volume = read_ct_files(folder.path());
    EXPECT_TRUE(mentions(volume, "gantry tilted by")) << tilt_deg;
    EXPECT_NEAR(volume.spacing_mm.z(), 1.5 * std::cos(t), 1e-6);
    EXPECT_GT(volume.dims.y(), 28);
    EXPECT_EQ(volume.dims.x(), 32);
    // Only what no slice covers is air.
    expect_field(volume, 1.0, 0.95 * 28.0 / volume.dims.y());
    const double sheared = 1.5 * 11 * std::abs(std::sin(t)) / 0.7;
    EXPECT_EQ(volume.dims.y(), 28 + static_cast<int>(std::ceil(sheared - 1e-3)));
  }
}

TEST(DicomRepairs, UnevenSlicesAreResampledAtTheMedianDistance) {
  const test::TemporaryFolder folder;
  write_series(folder.path(), up({0, 1.0, 2.0, 3.3, 4.0, 5.4, 6.4, 7.4, 8.1}), Mat3::Identity());
  const HuVolume volume = read_ct_files(folder.path());
  EXPECT_TRUE(mentions(volume, "0.7 to 1.4 mm apart"));
  EXPECT_NEAR(volume.spacing_mm.z(), 1.0, 1e-6);
  EXPECT_EQ(volume.dims.z(), 9);
  expect_field(volume, 1.0, 1.0);
}

TEST(DicomRepairs, RoundedPositionsDoNotAddUp) {
  const test::TemporaryFolder folder;
  std::vector<double> heights;
  for (int i = 0; i < 60; ++i) heights.push_back(std::floor(62.5 * i + 0.5) / 100.0);
  write_series(folder.path(), up(heights), Mat3::Identity());
  const HuVolume volume = read_ct_files(folder.path());
  EXPECT_EQ(volume.dims.z(), 60);
  EXPECT_NEAR(volume.spacing_mm.z(), 0.625, 2e-4);
  EXPECT_TRUE(volume.warnings.empty());
}

TEST(DicomRepairs, MissingSlicesAreInterpolatedAndCounted) {
  const test::TemporaryFolder folder;
  write_series(folder.path(), up({0, 2, 4, 6, 8, 14, 16, 18, 22, 24, 26, 28}), Mat3::Identity());
  const HuVolume volume = read_ct_files(folder.path());
  EXPECT_EQ(volume.dims.z(), 15);
  EXPECT_TRUE(mentions(volume, "3 missing slices were interpolated"));
  expect_field(volume, 1.0, 1.0);
}

TEST(DicomRepairs, AStraySliceIsLeftOut) {
  const test::TemporaryFolder folder;
  std::vector<double> heights{-150.0};
  for (int i = 0; i < 12; ++i) heights.push_back(i);
  write_series(folder.path(), up(heights), Mat3::Identity());
  const HuVolume volume = read_ct_files(folder.path());
  EXPECT_EQ(volume.dims.z(), 12);
  EXPECT_TRUE(mentions(volume, "1 stray slices"));
  expect_field(volume, 1.0, 1.0);
}

TEST(DicomRepairs, OrderOfFilesAndDirectionDoNotMatter) {
  std::vector<double> heights;
  for (int i = 0; i < 10; ++i) heights.push_back(1.2 * i);
  std::shuffle(heights.begin(), heights.end(), std::mt19937(test::seed()));
  const Mat3 oblique = rotation_from_small_vector({0.7, -0.4, 0.2});
  std::vector<Vec3> places;
  for (const double h : heights) places.push_back(Vec3(5, 6, 7) + h * oblique.col(2));
  const test::TemporaryFolder folder;
  write_series(folder.path(), places, oblique);
  const HuVolume volume = read_ct_files(folder.path());
  EXPECT_TRUE(volume.warnings.empty()) << volume.warnings.front();
  EXPECT_NEAR(volume.world_from_volume.rotation.determinant(), 1.0, 1e-12);
  expect_field(volume, 1.0, 1.0);
}

TEST(DicomRepairs, AScanMadeTwiceIsNotMixed) {
  const test::TemporaryFolder folder;
  write_series(folder.path(), up({0, 1, 2, 3}), Mat3::Identity());
  fs::create_directories(folder.path() / "a-second");
  HuVolume again = read_ct_files(folder.path());
  std::fill(again.hu.begin(), again.hu.end(), int16_t{77});
  write_dicom_folder(again, folder.path() / "a-second", 1);
  for (int i = 1; i <= 4; ++i)
    test::set_text(slice_file(folder.path() / "a-second", i), 0x0020, 0x0013, std::to_string(100 + i));
  const HuVolume volume = read_ct_files(folder.path());
  EXPECT_TRUE(mentions(volume, "4 slices at the place of another"));
  expect_field(volume, 1.0, 1.0);
}

TEST(DicomRepairs, WhatIsNoSliceIsLeftOutAndSaid) {
  const test::TemporaryFolder folder;
  write_series(folder.path(), up({0, 1, 2, 3, 4, 5}), Mat3::Identity());
  const auto extra = [&](const char* name, const std::function<void(gdcm::DataSet&)>& change) {
    const fs::path file = folder.path() / name;
    fs::copy_file(slice_file(folder.path(), 3), file);
    test::change_dicom(file, change);
  };
  extra("survey", [](auto& set) { test::put_text(set, 0x0008, 0x0008, "ORIGINAL\\PRIMARY\\LOCALIZER"); });
  extra("pet", [](auto& set) { test::put_text(set, 0x0008, 0x0060, "PT"); });
  extra("colour", [](auto& set) { test::put_text(set, 0x0028, 0x0004, "PALETTE COLOR"); });
  extra("nowhere", [](auto& set) { set.Remove(gdcm::Tag(0x0020, 0x0032)); });
  folder.write("._slice_0001.dcm", "what a Mac adds");
  folder.write("__MACOSX/slice_0001.dcm", "what a Mac adds");
  const HuVolume volume = read_ct_files(folder.path());
  expect_field(volume, 1.0, 1.0);
  EXPECT_EQ(volume.dims.z(), 6);
  for (const char* words : {"1 survey images", "1 images that are no CT (PT)",
                            "1 images in colour (PALETTE COLOR)", "1 images without position"})
    EXPECT_TRUE(mentions(volume, words)) << words;
  EXPECT_EQ(volume.warnings.size(), 4u);
}

TEST(DicomSeries, AreChosenByUidElseTheLargest) {
  const test::TemporaryFolder folder;
  std::map<int, std::string> uid_of;  // by slices
  for (const auto& [name, slices, seed] :
       {std::tuple{"a", 4, 1}, std::tuple{"b", 7, 2}, std::tuple{"c", 5, 3}}) {
    std::vector<double> heights;
    for (int i = 0; i < slices; ++i) heights.push_back(i * 0.5 * seed);
    fs::create_directories(folder.path() / name);
    write_series(folder.path() / name, up(heights), Mat3::Identity(), static_cast<uint64_t>(seed));
    const std::string uid = parse_dicom(test::slice_file(folder.path() / name, 1)).set.values.at(0x0020000e);
    uid_of[slices] = uid.substr(0, uid.find_last_not_of(std::string(" \0", 2)) + 1);
  }
  for (const auto& [slices, uid] : uid_of) {
    const HuVolume volume = read_ct_files(folder.path(), {.series_uid = uid, .keep_names = false});
    EXPECT_EQ(volume.dims, Vec3i(32, 28, slices));
    EXPECT_TRUE(mentions(volume, "there are 3 CT series"));
    EXPECT_FALSE(mentions(volume, uid)) << "the UID would lead back to the patient";
    expect_field(volume, 1.0, 1.0);
  }
  EXPECT_EQ(read_ct_files(folder.path()).dims.z(), 7);
  test::expect_error(ErrorKind::not_found, "1.2.3",
                     [&] { read_ct_files(folder.path(), {.series_uid = "1.2.3", .keep_names = false}); });
}

}  // namespace
}  // namespace ream::reader
