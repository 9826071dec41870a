#include <gtest/gtest.h>
#include <sys/resource.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "core/file.hpp"
#include "ct/read/gray_volume.hpp"
#include "ct/read/read_ct.hpp"
#include "isolation/isolated_service.hpp"
#include "isolation/sandbox.hpp"
#include "store/zip_archive.hpp"
#include "support/expect_error.hpp"
#include "support/full_tests.hpp"
#include "support/seed.hpp"
#include "support/temporary_folder.hpp"

namespace ream::ct {
namespace {

namespace fs = std::filesystem;

/// Volumes whose headers ask for a file of somebody else. Whatever is read of them must not hold its bytes.
class HostileVolume : public testing::Test {
 protected:
  static constexpr int side = 8;
  static constexpr int16_t secret_value = 1234;

  HostileVolume() {
    fs::create_directories(folder_.path() / "given");
    fs::create_directories(folder_.path() / "private");
    std::ofstream out(secret(), std::ios::binary);
    for (int i = 0; i < side * side * side; ++i)
      out.write(reinterpret_cast<const char*>(&secret_value), sizeof secret_value);
  }

  fs::path secret() const { return folder_.path() / "private/secret.raw"; }

  /// Refused, or read without a byte of the secret.
  void expect_kept(const std::string& name, const std::string& header, bool voxels = true) {
    const fs::path file = folder_.path() / "given" / name;
    std::ofstream(file, std::ios::binary)
        << header << (voxels ? std::string(side * side * side * 2, '\1') : std::string());
    const auto look = [&](const fs::path& path) {
      try {
        for (const int16_t hu : read_ct(path).hu) ASSERT_NE(hu, secret_value) << path << '\n' << header;
      } catch (const Error& error) {
        EXPECT_TRUE(error.kind() == ErrorKind::invalid_input || error.kind() == ErrorKind::not_found)
            << error.what();
      }
    };
    look(file);
    const fs::path zip = folder_.path() / "given.zip";
    store::write_zip(zip, {{file, "deep/er/" + name}});
    look(zip);
    fs::remove(zip);
    fs::remove(file);
  }

  /// A header and whether voxels follow it.
  struct Spelling {
    std::string name, header;
    bool voxels = true;
  };
  /// Each is a process of its own: in full tests all, else a random third.
  void expect_kept(std::vector<Spelling> spellings) {
    std::mt19937 random(test::seed());
    std::shuffle(spellings.begin(), spellings.end(), random);
    spellings.resize(test::tried_of(spellings.size(), spellings.size() / 3));
    for (const auto& [name, header, voxels] : spellings) expect_kept(name, header, voxels);
  }

  test::TemporaryFolder folder_;
};

std::string nrrd(const std::string& line) {
  return "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 8 8 8\n"
         "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nendian: little\nencoding: raw\n" +
         line + "\n\n";
}

std::string meta(const std::string& lines) {
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = "
         "False\n"
         "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\nElementSpacing = 1 1 1\nDimSize = 8 8 8\n"
         "ElementType = MET_SHORT\n" +
         lines + "\n";
}

TEST_F(HostileVolume, NoSpellingOfANrrdReadsAFileOfSomebodyElse) {
  std::vector<Spelling> spellings;
  const std::string by_path = secret().string(), upwards = "../private/secret.raw";
  for (const std::string& to :
       {by_path, upwards, "./" + upwards, "./given/../" + upwards, "/proc/self/root" + by_path})
    for (const char* key : {"data file: ", "datafile: ", "Data File: ", "DATA FILE:", "DataFile: ",
                            "data  file: ", "data\tfile: ", " data file: ", "data file:= ", "datafile:="}) {
      spellings.push_back({"a.nrrd", nrrd(key + to)});
      spellings.push_back({"a.nhdr", nrrd(key + to), false});
    }
  expect_kept(spellings);
  expect_kept("a.nhdr", nrrd("data file: LIST\n" + by_path), false);
  expect_kept("a.nhdr", nrrd("data file: " + by_path + "%d 0 0 1"), false);
  expect_kept("a.nrrd", nrrd("byte skip: -1\ndata file: " + by_path));
}

TEST_F(HostileVolume, NoSpellingOfAMetaImageReadsAFileOfSomebodyElse) {
  std::vector<Spelling> spellings;
  const std::string by_path = secret().string(), upwards = "../private/secret.raw";
  for (const std::string& to : {by_path, upwards, std::string("/proc/self/root") + by_path})
    for (const char* before : {"", "Element DataFile = LOCAL\n", "elementdatafile = LOCAL\n",
                               "ElementDataFile2 = LOCAL\n", "Comment = ElementDataFile = LOCAL\n",
                               "ElementDataFile : LOCAL\n", "\n", "Comment = a\r", "Comment\n"}) {
      spellings.push_back({"a.mha", meta(std::string(before) + "ElementDataFile = " + to)});
      spellings.push_back({"a.mhd", meta(std::string(before) + "ElementDataFile = " + to), false});
      spellings.push_back({"a.mhd", meta(std::string(before) + "ElementDataFile = LIST\n" + to), false});
      spellings.push_back({"a.mhd", meta(std::string(before) + "ElementDataFile=" + to), false});
    }
  expect_kept(spellings);
}

TEST_F(HostileVolume, ALinkInAFolderLeadsNowhere) {
  if (isolation::sandbox_support().landlock == 0) GTEST_SKIP() << "this kernel has no Landlock";
  fs::create_symlink(secret(), folder_.path() / "given/beside.raw");
  std::ofstream(folder_.path() / "given/a.nhdr") << nrrd("data file: beside.raw");
  EXPECT_THROW(read_ct(folder_.path() / "given/a.nhdr"), Error);
  EXPECT_THROW(GrayVolume(folder_.path() / "given/a.nhdr"), Error);
}

TEST_F(HostileVolume, AHeaderReadsThePlainFileBesideIt) {
  const fs::path given = folder_.path() / "given";
  for (const char* name : {"voxels.raw", ".hidden.raw"}) fs::copy_file(secret(), given / name);
  const auto header = [&](const std::string& name, const std::string& text) {
    std::ofstream(given / name) << text;
    return given / name;
  };
  for (const fs::path& file : {header("a.nhdr", nrrd("data file: voxels.raw")),
                               header("a.mhd", meta("ElementDataFile = voxels.raw"))}) {
    EXPECT_EQ(read_ct(file).hu, std::vector<int16_t>(side * side * side, secret_value)) << file;
    EXPECT_EQ(GrayVolume(file).dims(), Vec3i(side, side, side));
  }
  for (const fs::path& file : {header("b.nhdr", nrrd("data file: .hidden.raw")),
                               header("b.mhd", meta("ElementDataFile = .hidden.raw"))})
    test::expect_error(ErrorKind::invalid_input, "in one file beside it, not in '.hidden.raw'",
                       [&] { read_ct(file); });
}

/// A megabyte of zeros, packed, of 64-bit voxels that unpack to gigabytes.
TEST_F(HostileVolume, ASmallFileUnpacksToASmallVolume) {
  const fs::path file = folder_.path() / "given/bomb.nrrd";
  std::ofstream(file) << "NRRD0004\ntype: double\ndimension: 3\nspace: LPS\nsizes: 400 400 500\n"
                         "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nendian: little\n"
                         "encoding: gzip\n\n";
  const gzFile packed = ::gzopen(file.c_str(), "ab9");
  const std::string zeros(1 << 20, '\0');
  for (uint64_t left = uint64_t{400} * 400 * 500 * 8; left > 0;) {
    const auto piece = static_cast<unsigned>(std::min<uint64_t>(left, zeros.size()));
    ASSERT_EQ(::gzwrite(packed, zeros.data(), piece), static_cast<int>(piece));
    left -= piece;
  }
  ::gzclose(packed);
  ASSERT_LT(fs::file_size(file), 1'000'000u);
  ReadOptions options;
  options.max_bytes = 48 << 20;
  test::expect_error(ErrorKind::invalid_input,
                     "bomb.nrrd unpacks to a volume of 160 MB; of a file of this size at most 50 MB",
                     [&] { read_ct(file, options); });
}

/// What a file that took the reader over may answer: sides of 1.6 GB, over files of its choice.
TEST_F(HostileVolume, ClaimsOfTheReaderAreHeldAgainstItsFilesBeforeMemoryIsTaken) {
  const fs::path given = folder_.path() / "given/a.nrrd";
  std::ofstream(given) << "words";
  const auto answering = [&](const std::string& files, const std::string& answer) {
    const fs::path program = folder_.path() / "reader";
    std::ofstream(program) << "#!/bin/sh\ncd /proc/self/fd/" << isolation::output_descriptor << '\n'
                           << files << "\necho '{\"answer\": " << answer << "}' >&"
                           << isolation::answer_descriptor << '\n';
    fs::permissions(program, fs::perms::owner_all);
    return program;
  };
  const std::string volume = R"({"dims": [800, 1000, 1000], "spacing_mm": [1, 1, 1], "source": "x", )"
                             R"("rotation": [1, 0, 0, 0, 1, 0, 0, 0, 1], "origin_mm": [0, 0, 0]})";
  const std::string gray = R"({"gray": {"offset": 0, "step": 1, "exact": true}, "volume": )" + volume;
  rusage before{}, after{};
  ::getrusage(RUSAGE_SELF, &before);
  const auto refused = [&](const std::string& words, const std::string& files, uint64_t max_bytes) {
    ReadOptions options;
    options.max_bytes = max_bytes;
    options.reader = answering(files, volume);
    test::expect_error(ErrorKind::io, words, [&] { read_ct(given, options); });
  };
  refused("at most 1000000 are taken", "truncate -s 1600000000 values", 1'000'000);
  refused("20 bytes of values, but its answer needs 1600000000", "truncate -s 20 values", 2'000'000'000);
  refused("1600000001 bytes of values", "truncate -s 1600000001 values", 2'000'000'000);
  refused("without writing values", ":", 2'000'000'000);
  const auto gray_refused = [&](const std::string& words, const std::string& files, const std::string& end) {
    const fs::path program = answering(files, gray + end);
    test::expect_error(ErrorKind::io, words, [&] { GrayVolume(given, UINT64_MAX, no_progress, program); });
  };
  gray_refused("20 bytes of values", "truncate -s 20 values", "}");
  gray_refused("20 bytes of given", "truncate -s 20 values given", R"(, "given": true})");
  gray_refused("needs 0", "truncate -s 20 values; truncate -s 100000000 given", R"(, "given": true})");
  ::getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 100'000) << "kB";
}

}  // namespace
}  // namespace ream::ct
