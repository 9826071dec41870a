#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/file.hpp"
#include "ct/read/gray_volume.hpp"
#include "ct/read/read_ct.hpp"
#include "support/expect_error.hpp"
#include "support/places.hpp"
#include "support/temporary_folder.hpp"

namespace ream::ct {
namespace {

namespace fs = std::filesystem;

/// Files that the reference library wrote.
class Nifti2 : public testing::Test {
 protected:
  fs::path written(const std::string& name) {
    const fs::path file = folder_.path() / name;
    const fs::path program = fs::path(test::build_folder()) / "write_nifti2";
    EXPECT_EQ(std::system((program.string() + " " + file.string()).c_str()), 0);
    return file;
  }
  static void expect_volume(const HuVolume& volume) {
    ASSERT_EQ(volume.dims, Vec3i(7, 5, 4));
    EXPECT_LT((volume.spacing_mm - Vec3(0.4, 0.5, 1.25)).norm(), 1e-5);
    for (int w = 0; w < 4; ++w)
      for (int v = 0; v < 5; ++v)
        for (int u = 0; u < 7; ++u) {
          const double x = 0.4 * u, y = 0.5 * v;
          const Vec3 lps(-(12.5 + 0.8 * x - 0.6 * y), -(-40.25 + 0.6 * x + 0.8 * y), 300.125 + 1.25 * w);
          const Vec3i o = volume.voxel_at_world(lps);
          ASSERT_TRUE(volume.contains(o));
          EXPECT_LT((volume.world_of_centre(o) - lps).norm(), 1e-3);
          EXPECT_EQ(volume.hu[volume.index(o.x(), o.y(), o.z())], 100 * u + 10 * v + w - 300);
        }
  }
  void refuse(const std::string& why, const std::string& bytes) {
    test::expect_error(ErrorKind::invalid_input, why, [&] { read_ct(folder_.write("bad.nii", bytes)); });
  }
  test::TemporaryFolder folder_;
};

TEST_F(Nifti2, IsReadPlainAndPacked) {
  for (const char* name : {"ct.nii", "ct.nii.gz"}) {
    SCOPED_TRACE(name);
    const fs::path file = written(name);
    expect_volume(read_ct(file));
    EXPECT_TRUE(read_ct(file).warnings.empty());
    const GrayVolume gray(file);
    EXPECT_EQ(gray.dims(), Vec3i(7, 5, 4));
  }
}

/// Numbers of a NIfTI-2 header: how many bytes each, from where on, how many of them.
struct HeaderNumbers {
  size_t bytes, begin, count;
};

/// The same file as a big-endian machine writes it.
std::string big_endian(std::string bytes) {
  const auto swap = [&](size_t at, size_t width) {
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                 bytes.begin() + static_cast<std::ptrdiff_t>(at + width));
  };
  for (const HeaderNumbers numbers : {HeaderNumbers{4, 0, 1},
                                      {2, 12, 2},
                                      {8, 16, 8},
                                      {8, 80, 11 + 8},
                                      {8, 224, 2},
                                      {4, 344, 2},
                                      {8, 352, 6 + 12},
                                      {4, 496, 3}})
    for (size_t i = 0; i < numbers.count; ++i) swap(numbers.begin + i * numbers.bytes, numbers.bytes);
  constexpr size_t voxels = 544;
  for (size_t at = voxels; at + 1 < bytes.size(); at += 2) swap(at, 2);
  return bytes;
}

TEST_F(Nifti2, BigEndianOnesAreRead) {
  const fs::path file = folder_.write("big.nii", big_endian(read_text_file(written("ct.nii"))));
  expect_volume(read_ct(file));
  EXPECT_TRUE(read_ct(file).warnings.empty());
  EXPECT_EQ(GrayVolume(file).dims(), Vec3i(7, 5, 4));
  const std::string whole = read_text_file(file);
  refuse("cut short", whole.substr(0, whole.size() - 1));
  std::string larger = whole;
  larger[16 + 8 + 6] = 1;  // 256 voxels more along x
  refuse("more voxels than the file holds", larger);
}

TEST_F(Nifti2, WhatItsHeaderCannotMeanIsRefused) {
  const std::string good = read_text_file(written("ct.nii"));
  const auto with = [&](size_t at, auto value) {
    std::string bytes = good;
    std::memcpy(bytes.data() + at, &value, sizeof value);
    return bytes;
  };
  constexpr size_t dim = 16, voxels_begin = 168, rows = 400;
  refuse("cut short", good.substr(0, good.size() - 1));
  refuse("cut short", good.substr(0, 400));
  refuse("too large", with(dim + 8, int64_t{1} << 40));
  refuse("more voxels than the file holds", with(dim + 8, int64_t{30000}));
  refuse("-7 voxels", with(dim + 8, int64_t{-7}));
  refuse("number of dimensions", with(dim, int64_t{9}));
  refuse("begin at byte", with(voxels_begin, int64_t{-1}));
  refuse("begin at byte", with(voxels_begin, int64_t{1} << 60));
  refuse("two voxel sizes", with(rows, 9.0));
}

}  // namespace
}  // namespace ream::ct
