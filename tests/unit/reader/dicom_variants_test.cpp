#include <gtest/gtest.h>

#include <fstream>

#include "core/file.hpp"
#include "ct/read/write_volume.hpp"
#include "reader/ct_files.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "unit/reader/changed_dicom.hpp"

namespace ream::reader {
using namespace ct;
namespace {

namespace fs = std::filesystem;
using test::mentions, test::slice_file;
using Syntax = gdcm::TransferSyntax;

/// Air, bone and everything between, different in every slice; slices divisible by their number.
HuVolume stack_of_variants(int slices = 4) {
  HuVolume volume;
  volume.dims = {40, 24, slices};
  volume.spacing_mm = {0.7, 0.8, 1.25};
  volume.world_from_volume.translation_mm = {-100, 20, 30};
  volume.world_from_volume.rotation = rotation_from_small_vector({0.1, -0.2, 0.05});
  for (int w = 0; w < slices; ++w)
    for (int v = 0; v < 24; ++v)
      for (int u = 0; u < 40; ++u)
        volume.hu.push_back(static_cast<int16_t>((w + 1) * ((u * u + 7 * v * u + 13 * w) % 800 - 250)));
  return volume;
}

void expect_same(const HuVolume& back, const HuVolume& volume) {
  EXPECT_EQ(back.hu, volume.hu);
  ASSERT_EQ(back.dims, volume.dims);
  EXPECT_LT((back.world_of_centre(Vec3i::Zero()) - volume.world_of_centre(Vec3i::Zero())).norm(), 1e-4);
  EXPECT_LT((back.world_of_centre(back.dims) - volume.world_of_centre(volume.dims)).norm(), 1e-4);
}

class TransferSyntaxes : public testing::TestWithParam<Syntax::TSType> {};

TEST_P(TransferSyntaxes, GiveBackTheVolume) {
  const test::TemporaryFolder folder;
  write_dicom_folder(stack_of_variants(), folder.path(), 1);
  for (int i = 1; i <= 4; ++i) test::transcode(slice_file(folder.path(), i), GetParam());
  const HuVolume back = read_ct_files(folder.path());
  expect_same(back, stack_of_variants());
  EXPECT_TRUE(back.warnings.empty());
}

TEST_P(TransferSyntaxes, ATruncatedSliceIsNamed) {
  // GDCM writes eight bytes behind a deflated stream that mean nothing.
  const double nearly = GetParam() == Syntax::DeflatedExplicitVRLittleEndian ? 0.99 : 0.999;
  for (const double share : {nearly, 0.8, 0.5, 0.2, 0.05}) {
    const test::TemporaryFolder folder;
    write_dicom_folder(stack_of_variants(), folder.path(), 1);
    for (int i = 1; i <= 4; ++i) test::transcode(slice_file(folder.path(), i), GetParam());
    const fs::path file = slice_file(folder.path(), 3);
    fs::resize_file(file, static_cast<uintmax_t>(static_cast<double>(fs::file_size(file)) * share));
    test::expect_error(ErrorKind::invalid_input, "slice_0003.dcm", [&] { read_ct_files(folder.path()); });
  }
}

/// GDCM looks for the next marker, misses the tables, and ends the program by an assertion.
TEST(DicomVariants, APackedSliceWithRubbishBetweenItsHeadersIsNamed) {
  const test::TemporaryFolder folder;
  write_dicom_folder(stack_of_variants(), folder.path(), 1);
  for (int i = 1; i <= 4; ++i) test::transcode(slice_file(folder.path(), i), Syntax::JPEGLosslessProcess14_1);
  const fs::path file = slice_file(folder.path(), 3);
  std::string bytes = read_text_file(file);
  const size_t start = bytes.find("\xff\xd8\xff"), tables = bytes.find("\xff\xc4", start);
  ASSERT_NE(tables, std::string::npos);
  const auto expect_refused_with = [&](size_t at, const std::string& instead) {
    std::string changed = bytes;
    changed.replace(at, instead.size(), instead);
    write_file_atomically(file, changed);
    test::expect_error(ErrorKind::invalid_input, "slice_0003.dcm", [&] { read_ct_files(folder.path()); });
  };
  expect_refused_with(tables, std::string("\0", 1));
  // Markers that have no length: GDCM reads the next header at once, and would find another one there.
  for (const char bare : {'\xd0', '\xd7', '\xd8', '\xd9', '\x01', '\x00'})
    expect_refused_with(tables, std::string("\xff") + bare);
}

INSTANTIATE_TEST_SUITE_P(Dicom, TransferSyntaxes,
                         testing::Values(Syntax::ImplicitVRLittleEndian, Syntax::ExplicitVRLittleEndian,
                                         Syntax::ExplicitVRBigEndian, Syntax::JPEGLosslessProcess14_1,
                                         Syntax::JPEGLosslessProcess14, Syntax::JPEGLSLossless,
                                         Syntax::JPEG2000Lossless, Syntax::RLELossless,
                                         Syntax::DeflatedExplicitVRLittleEndian),
                         [](const auto& syntax) {
                           std::string name = Syntax::GetTSString(syntax.param);
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

TEST(DicomVariants, HounsfieldUnitsByOtherNamesAreHuWithARemark) {
  const test::TemporaryFolder folder;
  write_dicom_folder(stack_of_variants(2), folder.path(), 1);
  const auto remarks_on = [&](const std::string& type) {
    for (int i = 1; i <= 2; ++i) test::set_text(slice_file(folder.path(), i), 0x0028, 0x1054, type);
    return read_ct_files(folder.path());
  };
  EXPECT_TRUE(remarks_on("HU").warnings.empty());
  EXPECT_TRUE(remarks_on("US").warnings.empty());
  for (const char* name : {"hu", "Hu", "Houndsfield Unit", "Houndsfield", "Hounsfield Units", "HOUNSFIELD"}) {
    const HuVolume volume = remarks_on(name);
    EXPECT_TRUE(mentions(volume, std::string("'") + name + "'; this was taken as HU")) << name;
    EXPECT_FALSE(mentions(volume, "not HU")) << name;
    EXPECT_EQ(volume.hu, stack_of_variants(2).hu);
  }
  for (const char* name : {"OD", "Z_EFF", "MGML"})
    EXPECT_TRUE(mentions(remarks_on(name), std::string("the slices hold ") + name + ", not HU")) << name;
  // What is no word of the standard's may be of a person, however short.
  for (const char* name : {"hounds", "HUE", "DOE^JANE", "Jane Doe, 12 March 1956"})
    EXPECT_TRUE(mentions(remarks_on(name), "the slices hold something else, not HU")) << name;
  for (const char* name : {"Hounf DOE^JANE", "HU 19580312", "hu \xE4"})
    EXPECT_TRUE(mentions(remarks_on(name), "their values 'something else'")) << name;
  EXPECT_TRUE(mentions(remarks_on("Hounsfield of Jane Doe"), "their values 'something else'"));
}

TEST(DicomVariants, WordsBurntIntoThePictureAreRemarkedOn) {
  const test::TemporaryFolder folder;
  write_dicom_folder(stack_of_variants(), folder.path(), 1);
  test::set_text(slice_file(folder.path(), 1), 0x0028, 0x0301, "NO");
  EXPECT_TRUE(read_ct_files(folder.path()).warnings.empty());
  for (int i = 2; i <= 4; ++i) test::set_text(slice_file(folder.path(), i), 0x0028, 0x0301, "YES");
  EXPECT_TRUE(
      mentions(read_ct_files(folder.path()), "3 slices say that words are burnt into their pictures"));
}

TEST(DicomVariants, RescalingIsEachSlicesOwn) {
  const test::TemporaryFolder folder;
  HuVolume volume = stack_of_variants();
  write_dicom_folder(volume, folder.path(), 1);
  const size_t pixels = volume.voxel_count() / 4;
  for (int i = 1; i <= 4; ++i) {
    test::set_text(slice_file(folder.path(), i), 0x0028, 0x1053, std::to_string(i) + ".5");
    test::set_text(slice_file(folder.path(), i), 0x0028, 0x1052, std::to_string(-10 * i));
  }
  const HuVolume back = read_ct_files(folder.path());
  for (size_t i = 0; i < volume.hu.size(); ++i) {
    const auto number = static_cast<double>(i / pixels + 1);
    const double hu = std::floor((number + 0.5) * volume.hu[i] - 10 * number + 0.5);
    ASSERT_EQ(back.hu[i], std::max(hu, -1024.0)) << i;
  }
}

TEST(DicomVariants, PaddingBecomesAirAlsoAsARange) {
  const test::TemporaryFolder folder;
  HuVolume volume = stack_of_variants(2);
  volume.hu[3] = -2000;
  volume.hu[4] = 3000;
  volume.hu[5] = 3010;
  volume.hu[6] = 3071;
  write_dicom_folder(volume, folder.path(), 1);
  for (int i = 1; i <= 2; ++i)
    test::change_dicom(slice_file(folder.path(), i), [](gdcm::DataSet& set) {
      test::put_number(set, 0x0028, 0x0120, 3000);
      test::put_number(set, 0x0028, 0x0121, 3020);
    });
  const HuVolume back = read_ct_files(folder.path());
  for (const size_t i : {3, 4, 5}) EXPECT_EQ(back.hu[i], min_hu) << i;
  EXPECT_EQ(back.hu[6], 3071);
  EXPECT_TRUE(mentions(back, "3 voxels below -1024 HU or marked as padding"));
}

TEST(DicomVariants, PaddingThatCannotBeToldFromTissueStays) {
  const test::TemporaryFolder folder;
  write_dicom_folder(stack_of_variants(2), folder.path(), 1);
  for (int i = 1; i <= 2; ++i)
    test::change_dicom(slice_file(folder.path(), i),
                       [](gdcm::DataSet& set) { test::put_number(set, 0x0028, 0x0120, 0); });
  EXPECT_EQ(read_ct_files(folder.path()).hu, stack_of_variants(2).hu);
}

TEST(DicomVariants, NamesAreKeptOnlyWhenAskedFor) {
  const test::TemporaryFolder folder;
  write_dicom_folder(stack_of_variants(2), folder.path(), 1);
  for (int i = 1; i <= 2; ++i) {
    test::set_text(slice_file(folder.path(), i), 0x0008, 0x0005, "ISO_IR 100");
    test::set_text(slice_file(folder.path(), i), 0x0010, 0x0010, "M\xfcller^Eva");
    test::set_text(slice_file(folder.path(), i), 0x0010, 0x0020, "4711");
  }
  const HuVolume stripped = read_ct_files(folder.path());
  EXPECT_FALSE(stripped.patient);
  for (const std::string& text : stripped.warnings) EXPECT_EQ(text.find("ller"), std::string::npos);
  EXPECT_EQ(stripped.source.find("ller"), std::string::npos);
  const HuVolume named = read_ct_files(folder.path(), {.series_uid = "", .keep_names = true});
  ASSERT_TRUE(named.patient);
  EXPECT_EQ(named.patient->name, "Müller^Eva");
  EXPECT_EQ(named.patient->id, "4711");
}

TEST(DicomVariants, AFilesNameIsKeptOnlyWhenAskedFor) {
  const test::TemporaryFolder folder;
  write_volume_file(stack_of_variants(), folder.path() / "Mueller_Eva.nrrd");
  EXPECT_EQ(read_ct_files(folder.path() / "Mueller_Eva.nrrd").source, "volume file (.nrrd)");
  EXPECT_NE(read_ct_files(folder.path() / "Mueller_Eva.nrrd", {.series_uid = "", .keep_names = true})
                .source.find("Mueller_Eva"),
            std::string::npos);
}

TEST(DicomVariants, OldFilesWithoutPreambleAreRead) {
  for (const auto syntax : {Syntax::ImplicitVRLittleEndian, Syntax::ExplicitVRLittleEndian}) {
    const test::TemporaryFolder folder;
    write_dicom_folder(stack_of_variants(), folder.path(), 1);
    for (int i = 1; i <= 4; ++i) {
      const fs::path file = slice_file(folder.path(), i);
      test::transcode(file, syntax);
      std::ifstream in(file, std::ios::binary);
      const std::string bytes(std::istreambuf_iterator<char>(in), {});
      // The meta group's length stands in its first element, (0002,0000) UL.
      uint32_t meta_bytes = 0;
      std::memcpy(&meta_bytes, bytes.data() + 140, 4);
      std::ofstream(file, std::ios::binary) << bytes.substr(144 + meta_bytes);
    }
    expect_same(read_ct_files(folder.path()), stack_of_variants());
    fs::resize_file(slice_file(folder.path(), 2), fs::file_size(slice_file(folder.path(), 2)) - 100);
    test::expect_error(ErrorKind::invalid_input, "slice_0002.dcm", [&] { read_ct_files(folder.path()); });
  }
}

TEST(DicomVariants, AnEnhancedFileIsReadFrameByFrame) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "enhanced";
  test::write_enhanced(stack_of_variants(), file);
  for (const fs::path& given : {file, folder.path()}) {
    const HuVolume back = read_ct_files(given);
    EXPECT_EQ(back.hu, stack_of_variants().hu);
    EXPECT_EQ(back.dims, stack_of_variants().dims);
    EXPECT_LT((back.world_of_centre({3, 2, 1}) - stack_of_variants().world_of_centre({3, 2, 1})).norm(),
              1e-3);
  }
}

TEST(DicomVariants, ManyFramesWithoutPlacesAreRefused) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "frames.dcm";
  test::write_enhanced(stack_of_variants(), file);
  test::change_dicom(file, [](gdcm::DataSet& set) {
    set.Remove(gdcm::Tag(0x5200, 0x9230));
    set.Remove(gdcm::Tag(0x5200, 0x9229));
  });
  test::expect_error(ErrorKind::invalid_input, "frames.dcm", [&] { read_ct_files(file); });
}

TEST(DicomVariants, ProgressGrowsAndMayCancel) {
  const test::TemporaryFolder folder;
  write_dicom_folder(stack_of_variants(), folder.path(), 1);
  double last = 0.0;
  read_ct_files(folder.path(), {}, [&](double share, std::string_view step) {
    EXPECT_GE(share, last);
    EXPECT_LE(share, 1.0);
    EXPECT_FALSE(step.empty());
    last = share;
  });
  EXPECT_EQ(last, 1.0);
  int calls = 0;
  test::expect_error(ErrorKind::cancelled, "enough", [&] {
    read_ct_files(folder.path(), {}, [&](double, std::string_view) {
      if (++calls == 6) throw Error(ErrorKind::cancelled, "enough");
    });
  });
}

}  // namespace
}  // namespace ream::reader
