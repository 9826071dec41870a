#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>

#include <Eigen/LU>
#include "core/text.hpp"
#include "ct/read/write_volume.hpp"
#include "reader/ct_files.hpp"
#include "reader/volume_file.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "unit/reader/changed_dicom.hpp"

namespace ream::reader {
using namespace ct;
namespace {

using test::TemporaryFolder;

/// HU that tell the voxel: 100 x + 10 y + z in the order of the file.
std::vector<int16_t> told(const Vec3i& dims) {
  std::vector<int16_t> hu;
  for (int w = 0; w < dims.z(); ++w)
    for (int v = 0; v < dims.y(); ++v)
      for (int u = 0; u < dims.x(); ++u) hu.push_back(static_cast<int16_t>(100 * u + 10 * v + w - 200));
  return hu;
}

/// Every voxel of the file is found at its place in the world, whatever axes the volume has in memory.
void expect_places(const HuVolume& volume, const Vec3i& dims, const Vec3& origin_mm, const Mat3& steps_mm) {
  EXPECT_NEAR(volume.world_from_volume.rotation.determinant(), 1.0, 1e-9);
  const auto hu = told(dims);
  for (int w = 0; w < dims.z(); ++w)
    for (int v = 0; v < dims.y(); ++v)
      for (int u = 0; u < dims.x(); ++u) {
        const Vec3 world = origin_mm + steps_mm * Vec3(u, v, w);
        const Vec3i o = volume.voxel_at_world(world);
        ASSERT_TRUE(volume.contains(o));
        EXPECT_LT((volume.world_of_centre(o) - world).norm(), 2e-3);
        EXPECT_EQ(volume.hu[volume.index(o.x(), o.y(), o.z())],
                  hu[static_cast<size_t>(u + dims.x() * (v + dims.y() * w))]);
      }
}

const Vec3i volume_dims(4, 3, 5);
const Vec3 spacing(0.5, 0.75, 1.5), origin(-30, 12, 400);

/// The NIfTI-1 header as its standard lays it out, written here byte by byte.
void write_nifti(const std::filesystem::path& file, const Mat3& ras_steps_mm, const Vec3& ras_origin_mm,
                 bool by_qform) {
  std::string bytes(352, '\0');
  const auto put = [&](size_t at, auto value) { std::memcpy(bytes.data() + at, &value, sizeof value); };
  put(0, int32_t{348});
  const int16_t extent[8] = {3, 4, 3, 5, 1, 1, 1, 1};
  for (size_t k = 0; k < 8; ++k) put(40 + 2 * k, extent[k]);
  put(70, int16_t{4});   // signed short
  put(72, int16_t{16});  // bits
  put(76, 1.0f);
  for (int k = 0; k < 3; ++k)
    put(static_cast<size_t>(80 + 4 * k), static_cast<float>(ras_steps_mm.col(k).norm()));
  put(108, 352.0f);
  put(112, 1.0f);
  bytes[123] = 2;  // mm
  if (by_qform) {
    // Half a turn about the axis (x + y) / sqrt 2: exchanges x and y, turns z round.
    put(252, int16_t{1});
    put(256, static_cast<float>(std::sqrt(0.5)));
    put(260, static_cast<float>(std::sqrt(0.5)));
    put(264, 0.0f);
    for (int k = 0; k < 3; ++k) put(static_cast<size_t>(268 + 4 * k), static_cast<float>(ras_origin_mm[k]));
  } else {
    put(254, int16_t{1});
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column)
        put(static_cast<size_t>(280 + 16 * row + 4 * column), static_cast<float>(ras_steps_mm(row, column)));
      put(static_cast<size_t>(292 + 16 * row), static_cast<float>(ras_origin_mm[row]));
    }
  }
  std::memcpy(bytes.data() + 344, "n+1", 4);
  const auto hu = told(volume_dims);
  bytes.append(reinterpret_cast<const char*>(hu.data()), 2 * hu.size());
  std::ofstream(file, std::ios::binary) << bytes;
}

const Mat3 lps_from_ras = Vec3(-1, -1, 1).asDiagonal();

TEST(VolumeAxes, NiftiIsTurnedFromRasToLps) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "ct.nii";
  std::vector<Mat3> rotations{Mat3::Identity(), rotation_from_small_vector({0.3, -0.2, 0.6})};
  rotations.push_back(Vec3(-1, 1, 1).asDiagonal());  // left-handed: radiological storage
  rotations.push_back(rotations[1] * rotations[2]);
  for (const Mat3& rotation : rotations) {
    const Mat3 ras_steps = rotation * spacing.asDiagonal();
    write_nifti(file, ras_steps, origin, false);
    const HuVolume volume = read_ct_files(file);
    EXPECT_TRUE(volume.warnings.empty());
    expect_places(volume, volume_dims, lps_from_ras * origin, lps_from_ras * ras_steps);
  }
}

TEST(VolumeAxes, NiftiByItsQuaternion) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "ct.nii";
  Mat3 half_turn;
  half_turn << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  const Mat3 ras_steps = half_turn * spacing.asDiagonal();
  write_nifti(file, ras_steps, origin, true);
  expect_places(read_ct_files(file), volume_dims, lps_from_ras * origin, lps_from_ras * ras_steps);
}

/// The library would end the program (its SVD asserts that all numbers are finite).
TEST(VolumeAxes, NiftiWhoseAxesAreNoNumbersIsRefused) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "ct.nii";
  const auto write_number = [&](std::streamoff at, float value) {
    std::fstream out(file, std::ios::binary | std::ios::in | std::ios::out);
    out.seekp(at);
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const bool by_quaternion : {false, true})
    for (std::streamoff at = by_quaternion ? 256 : 280; at < (by_quaternion ? 280 : 328); at += 4)
      for (const float value : {std::nanf(""), HUGE_VALF}) {
        write_nifti(file, spacing.asDiagonal(), origin, by_quaternion);
        write_number(at, value);
        test::expect_error(ErrorKind::invalid_input, "no number", [&] { read_ct_files(file); });
      }
}

TEST(VolumeAxes, AFlatNiftiImageIsRefusedBeforeTheLibrarySeesIt) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "ct.nii";
  write_nifti(file, spacing.asDiagonal(), origin, false);
  const int16_t dimensions = 2;
  std::fstream out(file, std::ios::binary | std::ios::in | std::ios::out);
  out.seekp(40);
  out.write(reinterpret_cast<const char*>(&dimensions), sizeof dimensions);
  out.seekp(280);
  out << std::string(48, '\0');
  out.close();
  test::expect_error(ErrorKind::invalid_input, "is a flat image; a CT has three dimensions",
                     [&] { read_ct_files(file); });
}

std::string three(const Vec3& v) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.12g,%.12g,%.12g)", v.x(), v.y(), v.z());
  return text;
}

void write_nrrd(const std::filesystem::path& file, const std::string& space, const Mat3& steps,
                const Vec3& start) {
  std::string text =
      "NRRD0004\ntype: short\ndimension: 3\nspace: " + space +
      "\nsizes: 4 3 5\nspace directions: " + three(steps.col(0)) + " " + three(steps.col(1)) + " " +
      three(steps.col(2)) +
      "\nkinds: domain domain domain\nendian: little\nencoding: raw\nspace origin: " + three(start) + "\n\n";
  const auto hu = told(volume_dims);
  text.append(reinterpret_cast<const char*>(hu.data()), 2 * hu.size());
  std::ofstream(file, std::ios::binary) << text;
}

TEST(VolumeAxes, NrrdOfEverySpaceAndHandedness) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "ct.nrrd";
  for (const Mat3& mirror : {Mat3(Mat3::Identity()), Mat3(Vec3(1, 1, -1).asDiagonal())}) {
    const Mat3 steps = rotation_from_small_vector({-0.4, 0.1, 0.3}) * mirror * spacing.asDiagonal();
    for (const char* space : {"left-posterior-superior", "LPS", "lps", "Left-Posterior-Superior"}) {
      SCOPED_TRACE(space);
      write_nrrd(file, space, steps, origin);
      expect_places(read_ct_files(file), volume_dims, origin, steps);
      EXPECT_TRUE(read_ct_files(file).warnings.empty());
    }
    for (const char* space : {"right-anterior-superior", "RAS", "ras", "Right-Anterior-Superior"}) {
      SCOPED_TRACE(space);
      write_nrrd(file, space, lps_from_ras * steps, lps_from_ras * origin);
      expect_places(read_ct_files(file), volume_dims, origin, steps);
      EXPECT_TRUE(read_ct_files(file).warnings.empty());
    }
    for (const char* space : {"left-anterior-superior", "LAS"}) {
      write_nrrd(file, space, steps, origin);
      test::expect_error(ErrorKind::invalid_input, lower(space), [&] { read_ct_files(file); });
    }
    for (const char* space : {"left-posterior-superior-time", "right-anterior-superior-time", "LPST", "RAST",
                              "LAST", "scanner-xyz-time", "3D-right-handed-time"}) {
      write_nrrd(file, space, steps, origin);
      test::expect_error(ErrorKind::invalid_input, "axis of time", [&] { read_ct_files(file); });
    }
    write_nrrd(file, "3D-right-handed", steps, origin);
    const HuVolume unknown = read_ct_files(file);
    expect_places(unknown, volume_dims, origin, steps);
    EXPECT_TRUE(test::mentions(unknown, "check the side"));
  }
}

TEST(VolumeAxes, NrrdFieldsInAnotherOrder) {
  const TemporaryFolder folder;
  const auto hu = told(volume_dims);
  const std::string voxels(reinterpret_cast<const char*>(hu.data()), 2 * hu.size());
  const std::string first =
      "NRRD0004\ntype: short\ndimension: 3\nsizes: 4 3 5\nspace directions: (0.5,0,0) (0,0.75,0) "
      "(0,0,1.5)\nspace origin: (-30,12,400)\nspace: left-posterior-superior\nendian: little\n"
      "encoding: raw\n";
  const auto inside = folder.write("ct.nrrd", first + "\n" + voxels);
  expect_places(read_ct_files(inside), volume_dims, origin, Mat3(spacing.asDiagonal()));
  folder.write("voxels.raw", voxels);
  const auto beside = folder.write("ct.nhdr", first + "data file: voxels.raw\n");
  expect_places(read_ct_files(beside), volume_dims, origin, Mat3(spacing.asDiagonal()));
}

TEST(VolumeAxes, MetaImageIsLps) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "ct.mha";
  const Mat3 rotation = rotation_from_small_vector({0.2, 0.5, -0.1});
  char head[600];
  std::snprintf(
      head, sizeof head,
      "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = "
      "False\n"
      "TransformMatrix = %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g\nOffset = -30 12 400\n"
      "ElementSpacing = 0.5 0.75 1.5\nDimSize = 4 3 5\nElementType = MET_SHORT\nElementDataFile = LOCAL\n",
      rotation(0, 0), rotation(1, 0), rotation(2, 0), rotation(0, 1), rotation(1, 1), rotation(2, 1),
      rotation(0, 2), rotation(1, 2), rotation(2, 2));
  std::string bytes = head;
  const auto hu = told(volume_dims);
  bytes.append(reinterpret_cast<const char*>(hu.data()), 2 * hu.size());
  std::ofstream(file, std::ios::binary) << bytes;
  expect_places(read_ct_files(file), volume_dims, origin, rotation * spacing.asDiagonal());
}

TEST(VolumeAxes, EveryFormatWrittenGivesBackTheWorld) {
  const TemporaryFolder folder;
  HuVolume volume;
  volume.dims = volume_dims;
  volume.spacing_mm = spacing;
  volume.world_from_volume.rotation = rotation_from_small_vector({0.6, -0.3, 0.2});
  volume.world_from_volume.translation_mm = origin;
  volume.hu = told(volume_dims);
  const Mat3 steps = volume.world_from_volume.rotation * spacing.asDiagonal();
  for (const char* name : {"a.nrrd", "a.nii", "a.nii.gz", "a.mha"}) {
    write_volume_file(volume, folder.path() / name);
    expect_places(read_ct_files(folder.path() / name), volume_dims, volume.world_of_centre(Vec3i::Zero()),
                  steps);
  }
  std::filesystem::create_directories(folder.path() / "series");
  write_dicom_folder(volume, folder.path() / "series", 3);
  expect_places(read_ct_files(folder.path() / "series"), volume_dims, volume.world_of_centre(Vec3i::Zero()),
                steps);
}

/// What is called raw may be read past the library, so both must take its bytes for the same voxels.
TEST(VolumeAxes, VoxelsAreRawOnlyWhereTheLibraryReadsThemAsTheyLie) {
  const TemporaryFolder folder;
  const auto begin_of = [&](const std::string& more) {
    const auto file = folder.write("a.mha", "ObjectType = Image\nNDims = 3\n" + more +
                                                "DimSize = 2 2 2\nElementSpacing = 1 1 1\n"
                                                "ElementType = MET_SHORT\nElementDataFile = LOCAL\n"
                                                "1 2 3 4 5 6 7 8 ");
    VolumeFile opened(file);
    return opened.header().raw_begin(opened.image_bytes());
  };
  EXPECT_GT(begin_of("BinaryData = True\n"), 0u);
  EXPECT_GT(begin_of("BinaryData = true\nBinaryDataByteOrderMSB = False\n"), 0u);
  EXPECT_EQ(begin_of("BinaryData = False\n"), 0u);
  EXPECT_EQ(begin_of(""), 0u);
  EXPECT_EQ(begin_of("BinaryData = True\nBinaryDataByteOrderMSB = true\n"), 0u);
  EXPECT_EQ(begin_of("BinaryData = True\nElementByteOrderMSB = 1\n"), 0u);
}

TEST(VolumeAxes, ANameOfVoxelsThatIsTooLongForAFileIsNoFile) {
  const TemporaryFolder folder;
  const std::string longest(5000, 'x');
  const auto meta = folder.write("a.mhd",
                                 "ObjectType = Image\nNDims = 3\nBinaryData = True\nDimSize = 2 2 2\n"
                                 "ElementType = MET_SHORT\nElementDataFile = " +
                                     longest + "\n");
  const auto nrrd = folder.write("a.nhdr",
                                 "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n"
                                 "data file: " +
                                     longest + "\n");
  test::expect_error(ErrorKind::invalid_input, "too long", [&] { read_volume_file(meta); });
  test::expect_error(ErrorKind::not_found, "no such file", [&] { read_volume_file(nrrd); });
}

}  // namespace
}  // namespace ream::reader
