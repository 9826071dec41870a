#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <sstream>

#include "ct/build/import.hpp"
#include "ct/read/read_ct.hpp"
#include "support/shared_data.hpp"
#include "unit/reader/changed_dicom.hpp"

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
  options.build.roi_mm = right_glenoid;
  options.label = label;
  options.side = case_::Side::right;
  options.build.upsample = 8;
  const case_::Case c = import_ct(dicom, "right", options).made;
  EXPECT_GE(c.bone.grid.dims.minCoeff(), 300);
  // The face met along its axis, as measured on the label map with a sphere fit.
  const auto entry = case_::surface_along(c.bone, {-133.5, -6.4, 225.6}, {0.706, 0.708, 0});
  ASSERT_TRUE(entry);
  EXPECT_NEAR((*entry - Vec3(-154.87, -27.89, 226.33)).norm(), 33.6, 1.5);
}

std::string bytes_of(const std::filesystem::path& file) {
  const gzFile in = gzopen(file.c_str(), "rb");
  std::string bytes(1 << 20, '\0');
  bytes.resize(static_cast<size_t>(std::max(0, gzread(in, bytes.data(), 1 << 20))));
  gzclose(in);
  return bytes;
}

/// The numbers of a decimal string in an explicit little-endian DICOM file, found by its bytes.
std::vector<double> numbers_at(const std::string& bytes, uint16_t group, uint16_t element) {
  const char key[6] = {static_cast<char>(group & 0xff),
                       static_cast<char>(group >> 8),
                       static_cast<char>(element & 0xff),
                       static_cast<char>(element >> 8),
                       'D',
                       'S'};
  const size_t at = bytes.find(std::string(key, 6));
  if (at == std::string::npos) return {};
  const size_t length = static_cast<unsigned char>(bytes[at + 6]);
  std::istringstream text(bytes.substr(at + 8, length));
  std::vector<double> numbers;
  for (std::string word; std::getline(text, word, '\\');) numbers.push_back(std::stod(word));
  return numbers;
}

/// Every slice of the volume lies where one file says, in the files' own words.
void expect_places_of_files(const HuVolume& volume, const std::filesystem::path& folder) {
  std::map<double, Vec3> places;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    const std::string bytes = bytes_of(file.path());
    const auto place = numbers_at(bytes, 0x0020, 0x0032), axes = numbers_at(bytes, 0x0020, 0x0037),
               size = numbers_at(bytes, 0x0028, 0x0030);
    ASSERT_EQ(place.size(), 3u) << file.path();
    EXPECT_EQ(axes, (std::vector<double>{1, 0, 0, 0, 1, 0}));
    EXPECT_NEAR(volume.spacing_mm.y(), size.at(0), 1e-9);
    EXPECT_NEAR(volume.spacing_mm.x(), size.at(1), 1e-9);
    places[place[2]] = {place[0], place[1], place[2]};
  }
  ASSERT_EQ(static_cast<int>(places.size()), volume.dims.z());
  int w = 0;
  for (const auto& [height, place] : places)
    EXPECT_LT((volume.world_of_centre({0, 0, w++}) - place).norm(), 0.01) << height;
  EXPECT_TRUE(volume.world_from_volume.rotation.isApprox(Mat3::Identity()));
}

TEST(SharedCt, TheShoulderLiesWhereItsFilesSay) {
  const auto dicom = test::shared_data("ct/shoulder_dicom");
  REAM_SKIP_WITHOUT(dicom);
  const HuVolume volume = read_ct(dicom);
  EXPECT_EQ(volume.dims, Vec3i(512, 512, 130));
  expect_places_of_files(volume, dicom);
  EXPECT_EQ(*std::min_element(volume.hu.begin(), volume.hu.end()), min_hu);
  ASSERT_EQ(volume.warnings.size(), 1u);
  EXPECT_TRUE(test::mentions(volume, "marked as padding"));
}

TEST(SharedCt, ThickSlicesAreReadAndWarnedOf) {
  const auto dicom = test::shared_data("ct/shoulder_thick_slices_dicom");
  REAM_SKIP_WITHOUT(dicom);
  const HuVolume volume = read_ct(dicom);
  EXPECT_EQ(volume.dims, Vec3i(512, 512, 10));
  EXPECT_NEAR(volume.spacing_mm.z(), 8.0, 0.01);
  expect_places_of_files(volume, dicom);
  EXPECT_TRUE(test::mentions(volume, "the slices are 8 mm thick"));
}

TEST(SharedCt, NiftiFilesLieWhereTheirHeadersSay) {
  for (const char* name : {"ct/totalseg_example_ct_sm_3mm.nii.gz", "ct/shoulder_right_ct.nii.gz"}) {
    const auto file = test::shared_data(name);
    REAM_SKIP_WITHOUT(file);
    const HuVolume volume = read_ct(file);
    const std::string header = bytes_of(file).substr(0, 352);
    const auto number = [&](size_t at) {
      float value = 0.0f;
      std::memcpy(&value, header.data() + at, 4);
      return static_cast<double>(value);
    };
    int16_t dims[8], sform = 0;
    std::memcpy(dims, header.data() + 40, sizeof dims);
    std::memcpy(&sform, header.data() + 254, 2);
    ASSERT_GT(sform, 0);
    EXPECT_EQ(volume.dims, Vec3i(dims[1], dims[2], dims[3]));
    for (const Vec3i& o :
         {Vec3i(0, 0, 0), Vec3i(dims[1] - 1, 0, 0), Vec3i(0, dims[2] - 1, 0), Vec3i(3, 5, dims[3] - 1)}) {
      Vec3 ras;
      for (size_t row = 0; row < 3; ++row)
        ras[static_cast<int>(row)] = number(280 + 16 * row) * o.x() + number(284 + 16 * row) * o.y() +
                                     number(288 + 16 * row) * o.z() + number(292 + 16 * row);
      const Vec3 lps(-ras.x(), -ras.y(), ras.z());
      // A left-handed file is held with its last axis reversed.
      Vec3i there = volume.voxel_at_world(lps);
      ASSERT_TRUE(volume.contains(there)) << name;
      EXPECT_LT((volume.world_of_centre(there) - lps).norm(), 0.01) << name;
      EXPECT_TRUE(there == o || there == Vec3i(o.x(), o.y(), dims[3] - 1 - o.z())) << name;
    }
  }
}

TEST(SharedCt, MicroCtLoadsAndIsSaidToBeNoHu) {
  const auto file = test::shared_data("microct/LHDL_3155_D_4_bc_200cube_19.5um.nrrd");
  REAM_SKIP_WITHOUT(file);
  const HuVolume volume = read_ct(file);
  EXPECT_EQ(volume.dims, Vec3i(200, 200, 200));
  EXPECT_LT((volume.spacing_mm - Vec3::Constant(0.0195)).norm(), 1e-9);
  EXPECT_TRUE(test::mentions(volume, "gray values, not HU"));
  EXPECT_TRUE(test::mentions(volume, "check the side"));
}

}  // namespace
}  // namespace ream::ct
