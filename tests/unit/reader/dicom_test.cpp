#include <gtest/gtest.h>

#include <fstream>

#include "ct/read/write_volume.hpp"
#include "reader/ct_files.hpp"
#include "reader/dicom_file.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::reader {
using namespace ct;
namespace {

namespace fs = std::filesystem;

/// HU grow by 10 a slice, so that an interpolated slice is known exactly.
HuVolume stack(int slices) {
  HuVolume volume;
  volume.dims = {8, 6, slices};
  volume.spacing_mm = {0.7, 0.7, 1.25};
  volume.world_from_volume.translation_mm = {-100, 20, 30};
  for (int w = 0; w < slices; ++w)
    for (int i = 0; i < 48; ++i) volume.hu.push_back(static_cast<int16_t>(10 * w + i));
  return volume;
}

fs::path slice(const fs::path& folder, int number) {
  char name[32];
  std::snprintf(name, sizeof name, "slice_%04d.dcm", number);
  return folder / name;
}

bool mentions_warning(const HuVolume& volume, const std::string& words) {
  for (const auto& warning : volume.warnings)
    if (warning.find(words) != std::string::npos) return true;
  return false;
}

TEST(Dicom, FileNamesAndOtherFilesDoNotMatter) {
  const test::TemporaryFolder folder;
  write_dicom_folder(stack(6), folder.path(), 1);
  fs::rename(slice(folder.path(), 1), folder.path() / "zz");
  folder.write("README.txt", "not a slice");
  const HuVolume volume = read_dicom_folder(folder.path());
  EXPECT_EQ(volume.hu, stack(6).hu);
  EXPECT_TRUE(volume.warnings.empty());
}

TEST(Dicom, AMissingSliceIsInterpolatedAndSaid) {
  const test::TemporaryFolder folder;
  write_dicom_folder(stack(8), folder.path(), 1);
  fs::remove(slice(folder.path(), 4));
  const HuVolume volume = read_dicom_folder(folder.path());
  EXPECT_EQ(volume.hu, stack(8).hu);
  EXPECT_TRUE(mentions_warning(volume, "1 missing slices"));
}

TEST(Dicom, AWideGapIsRefused) {
  const test::TemporaryFolder folder;
  write_dicom_folder(stack(20), folder.path(), 1);
  for (int i = 6; i <= 12; ++i) fs::remove(slice(folder.path(), i));
  test::expect_error(ErrorKind::invalid_input, "slices are missing",
                     [&] { read_dicom_folder(folder.path()); });
}

TEST(Dicom, TheLargestSeriesIsTakenAndSaid) {
  const test::TemporaryFolder folder;
  for (const auto& [name, slices, seed] :
       {std::tuple{"a", 4, 1}, std::tuple{"b", 7, 2}, std::tuple{"c", 5, 3}}) {
    fs::create_directories(folder.path() / name);
    write_dicom_folder(stack(slices), folder.path() / name, static_cast<uint64_t>(seed));
  }
  const HuVolume volume = read_dicom_folder(folder.path());
  EXPECT_EQ(volume.dims.z(), 7);
  EXPECT_TRUE(mentions_warning(volume, "3 CT series"));
}

TEST(Dicom, DuplicatesAndOtherOrientationsAreLeftOut) {
  const test::TemporaryFolder folder;
  write_dicom_folder(stack(6), folder.path(), 1);
  fs::copy_file(slice(folder.path(), 3), folder.path() / "copy.dcm");
  HuVolume scout = stack(2);
  scout.world_from_volume.rotation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  fs::create_directories(folder.path() / "scout");
  write_dicom_folder(scout, folder.path() / "scout", 1);
  const HuVolume volume = read_dicom_folder(folder.path());
  EXPECT_EQ(volume.hu, stack(6).hu);
  EXPECT_TRUE(mentions_warning(volume, "1 slices at the place of another"));
  EXPECT_TRUE(mentions_warning(volume, "2 slices of another orientation"));
}

TEST(Dicom, EveryTruncationIsNoticed) {
  const test::TemporaryFolder folder;
  write_dicom_folder(stack(2), folder.path(), 1);
  const fs::path whole = slice(folder.path(), 1), part = folder.path() / "part";
  ASSERT_EQ(parse_dicom(whole).state, DicomState::whole);
  for (uintmax_t size = fs::file_size(whole); size-- > 0;) {
    fs::copy_file(whole, part, fs::copy_options::overwrite_existing);
    fs::resize_file(part, size);
    ASSERT_NE(parse_dicom(part).state, DicomState::whole) << size;
  }
}

TEST(Dicom, ATruncatedSliceIsNamed) {
  for (const double share : {0.99, 0.9, 0.5, 0.2, 0.01}) {
    const test::TemporaryFolder folder;
    write_dicom_folder(stack(5), folder.path(), 1);
    const fs::path file = slice(folder.path(), 3);
    fs::resize_file(file, static_cast<uintmax_t>(static_cast<double>(fs::file_size(file)) * share));
    test::expect_error(ErrorKind::invalid_input, "slice_0003.dcm", [&] { read_dicom_folder(folder.path()); });
  }
}

TEST(Dicom, EqualVolumesGiveEqualFiles) {
  const test::TemporaryFolder one, two;
  write_dicom_folder(stack(2), one.path(), 5);
  write_dicom_folder(stack(2), two.path(), 5);
  const auto bytes = [](const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(bytes(slice(one.path(), 2)), bytes(slice(two.path(), 2)));
}

TEST(Dicom, PaddingBecomesAirAndIsSaid) {
  const test::TemporaryFolder folder;
  HuVolume volume = stack(3);
  volume.hu[5] = -3024;
  write_dicom_folder(volume, folder.path(), 1);
  const HuVolume back = read_ct_files(folder.path());
  EXPECT_EQ(back.hu[5], min_hu);
  EXPECT_TRUE(mentions_warning(back, "1 voxels below -1024 HU"));
}

}  // namespace
}  // namespace ream::reader
