#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>

#include <cstring>
#include <fstream>
#include <functional>

#include "core/error.hpp"
#include "ct/read/write_volume.hpp"
#include "reader/ct_files.hpp"
#include "support/temporary_folder.hpp"
#include "unit/reader/changed_dicom.hpp"

namespace ream::reader {
using namespace ct;
namespace {

namespace fs = std::filesystem;
using test::slice_file, test::TemporaryFolder;

constexpr uint64_t allowed_bytes = uint64_t{256} << 20;  // what a small bad file may take while it is read

uint64_t virtual_bytes() {
  uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool limits_memory = false;  // a sanitizer's shadow takes terabytes of addresses
#else
constexpr bool limits_memory = true;
#endif

/// What read_ct says of a file in a process of its own that cannot take more than allowed_bytes, where
/// limits_memory: the error's text, or how else it ended.
std::string refusal(const fs::path& path, const ReadOptions& options = {}) {
  int ends[2];
  if (::pipe(ends) != 0) return "no pipe";
  const pid_t child = ::fork();
  if (child == 0) {
    if (limits_memory) {
      const rlim_t most = virtual_bytes() + allowed_bytes;
      const rlimit limit{most, most};
      ::setrlimit(RLIMIT_AS, &limit);
    }
    std::string said;
    try {
      read_ct_files(path, options);
      said = "no refusal";
    } catch (const Error& error) {
      said = error.what();
    } catch (const std::exception& error) {
      said = std::string("another exception: ") + error.what();
    }
    const auto written = ::write(ends[1], said.data(), said.size());
    ::_exit(written == static_cast<ssize_t>(said.size()) ? 0 : 1);
  }
  ::close(ends[1]);
  std::string said;
  char piece[4096];
  for (ssize_t got = 0; (got = ::read(ends[0], piece, sizeof piece)) > 0;)
    said.append(piece, static_cast<size_t>(got));
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) return "ended by signal " + std::to_string(WTERMSIG(status));
  return said;
}

void expect_refused(const fs::path& path, const std::string& named, const std::string& why,
                    const ReadOptions& options = {}) {
  const std::string said = refusal(path, options);
  EXPECT_NE(said.find(named), std::string::npos) << said;
  EXPECT_NE(said.find(why), std::string::npos) << said;
  EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  EXPECT_EQ(said.find("another exception"), std::string::npos) << said;
}

HuVolume small() {
  HuVolume volume;
  volume.dims = {20, 16, 8};
  volume.spacing_mm = {0.7, 0.8, 1.25};
  for (size_t i = 0; i < volume.voxel_count(); ++i) volume.hu.push_back(static_cast<int16_t>(i % 900) - 300);
  return volume;
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

class MalformedVolume : public testing::Test {
 protected:
  std::string whole(const std::string& name) {
    write_volume_file(small(), folder_.path() / name);
    return bytes_of(folder_.path() / name);
  }
  fs::path file(const std::string& name) const { return folder_.path() / name; }

  TemporaryFolder folder_;
};

/// Header lines of a raw NRRD of 1 kB of data.
std::string nrrd(const std::string& sizes, const std::string& directions, const std::string& more = "") {
  return "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: " + sizes +
         "\nspace directions: " + directions +
         "\nkinds: domain domain domain\nendian: little\nencoding: raw\n" + more +
         "space origin: (0,0,0)\n\n" + std::string(1024, '\1');
}
const std::string unit = "(1,0,0) (0,1,0) (0,0,1)";

TEST_F(MalformedVolume, LyingNrrdHeaders) {
  const auto refused = [&](const std::string& text, const std::string& why) {
    write_bytes(file("bad.nrrd"), text);
    expect_refused(file("bad.nrrd"), "bad.nrrd", why);
  };
  refused(nrrd("512 512 1000000000", unit), "at most 1e9");
  refused(nrrd("512 512 600", unit), "more voxels than the file holds");
  refused(nrrd("1000000000 1000000000 1000000000", unit), "at most 1e9");
  refused(nrrd("8 8 -8", unit), "-8 voxels");
  refused(nrrd("8 8 0", unit), "0 voxels");
  refused(nrrd("8 8 8", "(1,0,0) (0,0,0) (0,0,1)"), "voxel size of 0 mm");
  refused(nrrd("8 8 8", "(1,0,0) (0,nan,0) (0,0,1)"), "voxel size of nan mm");
  refused(nrrd("8 8 8", "(1,0,0) (0.3,1,0) (0,0,1)"), "not perpendicular");
  refused(nrrd("8 8 8", unit, "data file: /etc/passwd\n"), "beside it");
  refused(nrrd("8 8 8", unit, "data file: nowhere.raw\n"), "nowhere.raw");
  refused(nrrd("20 25 1", unit), "single slice");
  refused("NRRD0004\n", "bad.nrrd");
  refused("", "bad.nrrd");
}

TEST_F(MalformedVolume, LyingNiftiHeaders) {
  const std::string good = whole("bad.nii");
  const auto refused = [&](const std::function<void(std::string&)>& change, const std::string& why) {
    std::string bytes = good;
    change(bytes);
    write_bytes(file("bad.nii"), bytes);
    expect_refused(file("bad.nii"), "bad.nii", why);
  };
  const auto put = [](std::string& bytes, size_t at, auto value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
  };
  constexpr size_t dim = 40, bits = 72, pixdim = 76, sform = 254, srow_x = 280;
  refused([&](auto& b) { put(b, dim + 6, int16_t{32767}); }, "more voxels than the file holds");
  refused(
      [&](auto& b) {
        for (const size_t k : {2, 4, 6}) put(b, dim + k, int16_t{32767});
      },
      "at most 1e9");
  refused([&](auto& b) { put(b, dim + 4, int16_t{-16}); }, "-16 voxels");
  refused([&](auto& b) { put(b, dim, int16_t{77}); }, "number of dimensions");
  refused([&](auto& b) { put(b, pixdim + 4, 0.0f); }, "voxel size of 0 mm");
  refused([&](auto& b) { put(b, pixdim + 12, std::nanf("")); }, "voxel size of nan mm");
  refused([&](auto& b) { put(b, bits, int16_t{1}); }, "of two sizes");
  refused([&](auto& b) { b.resize(b.size() - 1); }, "more voxels than the file holds");
  refused([&](auto& b) { b.resize(200); }, "cut short");
  refused(
      [&](auto& b) {
        put(b, sform, int16_t{1});
        put(b, srow_x + 4, 0.5f);
      },
      "bad.nii");
  refused([&](auto& b) { b.replace(0, 8, "\x89PNG\r\n\x1a\n"); }, "no NIfTI");
  // The values, not the header, in the other byte order.
  refused(
      [&](auto& b) {
        for (size_t i = 352; i + 1 < b.size(); i += 2) std::swap(b[i], b[i + 1]);
      },
      "swapped");
}

TEST_F(MalformedVolume, LyingMetaImageHeaders) {
  const std::string head =
      "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = "
      "False\n"
      "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\nElementSpacing = 1 1 1\nDimSize = 8 8 8\n"
      "ElementType = MET_SHORT\nElementDataFile = LOCAL\n";
  const std::string data(1024, '\1');
  write_bytes(file("good.mha"), head + data);
  EXPECT_EQ(read_ct_files(file("good.mha")).dims, Vec3i(8, 8, 8));
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& why) {
    write_bytes(file("bad.mha"), replaced(head, from, to) + data);
    expect_refused(file("bad.mha"), "bad.mha", why);
  };
  refused("DimSize = 8 8 8", "DimSize = 512 512 1000000000", "at most 1e9");
  refused("DimSize = 8 8 8", "DimSize = 512 512 500", "more voxels than the file holds");
  refused("DimSize = 8 8 8", "DimSize = 8 -8 8", "-8 voxels");
  refused("DimSize = 8 8 8", "DimSize = 8 8", "number of voxels for each");
  refused("NDims = 3", "NDims = 1000000000", "number of dimensions");
  refused("Spacing = 1 1 1", "Spacing = 1 0 1", "voxel size of 0 mm");
  refused("Spacing = 1 1 1", "Spacing = 1 nan 1", "voxel size of nan mm");
  refused("Spacing = 1 1 1", "Spacing = 1 -1 1", "voxel size of -1 mm");
  refused("Matrix = 1 0 0 0 1 0", "Matrix = 1 0 0 0.3 1 0", "not perpendicular");
  refused("= LOCAL", "= ../../etc/passwd", "beside it");
  refused("= LOCAL", "= LIST", "beside it");
  refused("= False\nTransform", "= True\nTransform", "bad.mha");
  write_bytes(file("cut.mha"), head + data.substr(0, 1000));
  expect_refused(file("cut.mha"), "cut.mha", "cut short");
}

TEST_F(MalformedVolume, OtherFilesByTheseNames) {
  for (const char* name : {"picture.nii", "picture.nii.gz", "picture.nrrd", "picture.mha", "picture.dcm"}) {
    write_bytes(file(name), "\x89PNG\r\n\x1a\n" + std::string(5000, 'x'));
    expect_refused(file(name), name, "");
  }
  write_bytes(file("unknown"), "hello");
  expect_refused(file("unknown"), "unknown", "not a volume");
}

/// A valid header that claims 1024 x 1024 x 300 voxels, packed a thousandfold: 0.6 GB of zeros.
void write_bomb(const fs::path& file, std::string header) {
  const int16_t dims[3] = {1024, 1024, 300};
  std::memcpy(header.data() + 42, dims, sizeof dims);
  const gzFile bomb = gzopen(file.c_str(), "wb1");
  gzwrite(bomb, header.data(), 352);
  const std::string zeros(1 << 20, '\0');
  for (int i = 0; i < 600; ++i) gzwrite(bomb, zeros.data(), static_cast<unsigned>(zeros.size()));
  gzclose(bomb);
}

/// Where memory is limited, what it unpacks to does not fit: another refusal would be given.
TEST_F(MalformedVolume, APackedBombIsCountedNotUnpacked) {
  write_bomb(file("bomb.nii.gz"), whole("small.nii").substr(0, 352));
  ReadOptions options;
  options.max_bytes = allowed_bytes;
  expect_refused(file("bomb.nii.gz"), "bomb.nii.gz", "unpacks to a volume of 629 MB", options);
}

TEST_F(MalformedVolume, WhatDoesNotFitIntoMemoryIsRefused) {
  if (!limits_memory) GTEST_SKIP() << "a sanitizer's memory cannot be limited";
  write_bomb(file("bomb.nii.gz"), whole("small.nii").substr(0, 352));
  expect_refused(file("bomb.nii.gz"), "bomb.nii.gz", "does not fit into memory");
}

TEST_F(MalformedVolume, NoKindOfFileMakesMoreThanIsTaken) {
  ReadOptions options;
  options.max_bytes = small().voxel_count() * sizeof(int16_t);
  for (const char* name : {"small.nrrd", "small.nii", "small.mha"}) whole(name);
  fs::create_directory(file("dicom"));
  write_dicom_folder(small(), file("dicom"), 1);
  std::ofstream rows(file("rows.txt"));
  for (size_t i = 0; i < small().voxel_count(); ++i)
    rows << i % 20 << ' ' << i / 20 % 16 << ' ' << i / 320 << " 5\n";
  rows.close();
  for (const char* name : {"small.nrrd", "small.nii", "small.mha", "dicom", "rows.txt"}) {
    EXPECT_EQ(read_ct_files(file(name), options).dims, small().dims) << name;
    ReadOptions less = options;
    --less.max_bytes;
    expect_refused(file(name), name, "unpacks to a volume", less);
  }
}

class MalformedDicom : public testing::Test {
 protected:
  void SetUp() override { write_dicom_folder(small(), folder_.path(), 1); }
  fs::path slice(int number) const { return slice_file(folder_.path(), number); }
  void change_all(const std::function<void(gdcm::DataSet&)>& change) {
    for (int i = 1; i <= 8; ++i) test::change_dicom(slice(i), change);
  }
  TemporaryFolder folder_;
};

TEST_F(MalformedDicom, ClaimedPixelsThatAreNotThere) {
  for (const int side : {65535, 8000}) {
    test::change_dicom(slice(4), [&](gdcm::DataSet& set) {
      test::put_number(set, 0x0028, 0x0010, side);
      test::put_number(set, 0x0028, 0x0011, side);
    });
    expect_refused(folder_.path(), "slice_0004.dcm", "more pixels than it holds");
  }
}

TEST_F(MalformedDicom, ALittleMoreClaimedInEverySlice) {
  change_all([](gdcm::DataSet& set) { test::put_number(set, 0x0028, 0x0010, 17); });
  expect_refused(folder_.path(), "slice_0001.dcm", "pixels");
}

TEST_F(MalformedDicom, ClaimedPixelsInPackedFiles) {
  for (const auto syntax : {gdcm::TransferSyntax::JPEG2000Lossless, gdcm::TransferSyntax::RLELossless,
                            gdcm::TransferSyntax::JPEGLosslessProcess14_1}) {
    const TemporaryFolder folder;
    write_dicom_folder(small(), folder.path(), 1);
    for (int i = 1; i <= 8; ++i) {
      test::transcode(slice_file(folder.path(), i), syntax);
      test::change_dicom(slice_file(folder.path(), i), [](gdcm::DataSet& set) {
        test::put_number(set, 0x0028, 0x0010, 5000);
        test::put_number(set, 0x0028, 0x0011, 5000);
      });
    }
    expect_refused(folder.path(), "slice_0001.dcm", "");
  }
}

TEST_F(MalformedDicom, ManyFramesClaimed) {
  test::set_text(slice(1), 0x0028, 0x0008, "1000000000");
  expect_refused(folder_.path(), "slice_0001.dcm", "frames");
  test::set_text(slice(1), 0x0028, 0x0008, "90000");
  expect_refused(folder_.path(), "slice_0001.dcm", "more pixels than it holds");
}

TEST_F(MalformedDicom, ColourPictures) {
  change_all([](gdcm::DataSet& set) {
    test::put_text(set, 0x0028, 0x0004, "RGB");
    test::put_number(set, 0x0028, 0x0002, 3);
    gdcm::DataElement pixels(gdcm::Tag(0x7fe0, 0x0010), 0, gdcm::VR::OW);
    const std::string bytes(20 * 16 * 6, '\1');
    pixels.SetByteValue(bytes.data(), static_cast<uint32_t>(bytes.size()));
    set.Replace(pixels);
  });
  expect_refused(folder_.path(), "slice_0001.dcm", "in colour (RGB)");
}

TEST_F(MalformedDicom, OneBitPictures) {
  change_all([](gdcm::DataSet& set) {
    test::put_number(set, 0x0028, 0x0100, 1);
    test::put_number(set, 0x0028, 0x0101, 1);
  });
  expect_refused(folder_.path(), "slice_0001.dcm", "of 1 bits a pixel");
}

TEST_F(MalformedDicom, NumbersThatAreNone) {
  const auto all = [&](uint16_t group, uint16_t element, const char* text, const char* why) {
    change_all([&](gdcm::DataSet& set) { test::put_text(set, group, element, text); });
    expect_refused(folder_.path(), "slice_0001.dcm", why);
    SetUp();
  };
  all(0x0028, 0x0030, "nan\\nan", "pixel size");
  all(0x0028, 0x0030, "0\\0", "pixel size");
  all(0x0028, 0x0030, "-1\\1", "pixel size");
  all(0x0020, 0x0032, "0\\inf\\0", "position");
  all(0x0020, 0x0037, "1\\0\\0\\0.5\\1\\0", "not perpendicular");
  all(0x0028, 0x1053, "0", "slope");
  all(0x0028, 0x1053, "1e999", "slope");
}

TEST_F(MalformedDicom, NoneOneOrTextInsteadOfSlices) {
  const TemporaryFolder empty;
  expect_refused(empty.path(), empty.path(), "no CT slices");
  const TemporaryFolder one;
  fs::copy_file(slice(1), one.path() / "1.dcm");
  expect_refused(one.path(), one.path(), "single CT slice");
  expect_refused(one.path() / "1.dcm", "1.dcm", "single CT slice");
  folder_.write("report.dcm", "Findings: none");
  expect_refused(folder_.path(), "report.dcm", "not DICOM");
}

TEST_F(MalformedDicom, BytesSwappedThroughout) {
  std::string bytes = bytes_of(slice(2));
  for (size_t i = 0; i + 1 < bytes.size(); i += 2) std::swap(bytes[i], bytes[i + 1]);
  write_bytes(slice(2), bytes);
  expect_refused(folder_.path(), "slice_0002.dcm", "not DICOM");
}

TEST_F(MalformedDicom, ChangedBytesNeverEndTheProgram) {
  // Seeded damage anywhere in the header, or in packed pixels: refused in one line, or read.
  const std::string plain = bytes_of(slice(3));
  test::transcode(slice(3), gdcm::TransferSyntax::JPEGLosslessProcess14_1);
  const std::string packed = bytes_of(slice(3));
  uint64_t random = 20260101;
  for (int round = 0; round < 60; ++round) {
    std::string bytes = round % 2 == 0 ? plain : packed;
    for (int k = 0; k < 3; ++k) {
      random = random * 6364136223846793005u + 1442695040888963407u;
      bytes[(random >> 33) % bytes.size()] = static_cast<char>(random >> 20);
    }
    write_bytes(slice(3), bytes);
    const std::string said = refusal(folder_.path());
    EXPECT_EQ(said.find("signal"), std::string::npos) << "round " << round << ": " << said;
    EXPECT_EQ(said.find("another exception"), std::string::npos) << "round " << round << ": " << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace ream::reader
