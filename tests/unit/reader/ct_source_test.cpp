#include "reader/ct_source.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <zip.h>

#include <cstring>
#include <fstream>
#include <memory>

#include "ct/read/write_volume.hpp"
#include "reader/ct_files.hpp"
#include "store/zip_archive.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::reader {
using namespace ct;
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

ct::HuVolume small() {
  ct::HuVolume volume;
  volume.dims = {10, 8, 4};
  for (size_t i = 0; i < volume.voxel_count(); ++i) volume.hu.push_back(static_cast<int16_t>(i) - 100);
  return volume;
}

class CtSources : public testing::Test {
 protected:
  fs::path zip() const { return folder_.path() / "ct.zip"; }

  /// Zips files given by the names that they get and their bytes.
  void make(const std::vector<std::pair<std::string, std::string>>& files) {
    std::vector<store::ArchiveEntry> entries;
    for (const auto& [name, bytes] : files)
      entries.push_back({folder_.write("plain/" + std::to_string(entries.size()), bytes), name});
    store::write_zip(zip(), entries);
  }
  /// Lets libzip itself change the archive.
  void change(const std::function<void(zip_t*)>& how) {
    int code = 0;
    zip_t* archive = zip_open(zip().c_str(), ZIP_CREATE, &code);
    ASSERT_NE(archive, nullptr);
    how(archive);
    ASSERT_EQ(zip_close(archive), 0);
  }
  std::string series_zip(const std::string& below) {
    fs::create_directories(folder_.path() / "series");
    ct::write_dicom_folder(small(), folder_.path() / "series", 1);
    std::vector<store::ArchiveEntry> entries;
    for (const auto& file : fs::directory_iterator(folder_.path() / "series"))
      entries.push_back({file.path(), below + file.path().filename().string()});
    store::write_zip(zip(), entries);
    return zip();
  }
  std::string bytes_of(const fs::path& file) const {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void expect_refused(const std::string& why) {
    test::expect_error(ErrorKind::invalid_input, why, [&] {
      try {
        CtSource(zip(), no_progress, scratch_.path());
      } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("ct.zip"), std::string::npos) << error.what();
        throw;
      }
    });
    EXPECT_TRUE(scratch_.entries().empty());
  }

  TemporaryFolder folder_, scratch_;
};

TEST_F(CtSources, FoldersAndFilesAreTakenAsTheyAre) {
  EXPECT_EQ(CtSource(folder_.path()).path(), folder_.path());
  const fs::path file = folder_.write("ct.nrrd", "x");
  EXPECT_EQ(CtSource(file, no_progress, scratch_.path()).path(), file);
  EXPECT_TRUE(scratch_.entries().empty());
}

TEST_F(CtSources, AZippedSeriesIsReadAndLeavesNothing) {
  series_zip("patient/scan 1/");
  {
    int calls = 0;
    const CtSource source(
        zip(), [&](double, std::string_view step) { calls += step == "unpacking"; }, scratch_.path());
    EXPECT_EQ(calls, 4);
    const auto volume = source.read([](const fs::path& path) { return read_ct_files(path); });
    EXPECT_EQ(volume.hu, small().hu);
  }
  EXPECT_TRUE(scratch_.entries().empty());
}

TEST_F(CtSources, TheOneVolumeInAZipIsFound) {
  ct::write_volume_file(small(), folder_.path() / "a.nii.gz");
  const std::string volume = bytes_of(folder_.path() / "a.nii.gz");
  make({{"__MACOSX/._ct.nii.gz", "junk"},
        {"study/", ""},
        {"study/.DS_Store", "junk"},
        {"study/ct.nii.gz", volume},
        {"README.txt", "hello"}});
  const CtSource source(zip(), no_progress, scratch_.path());
  EXPECT_EQ(source.path().filename(), "ct.nii.gz");
  EXPECT_EQ(read_ct_files(source.path()).hu, small().hu);
  make({{"rows.txt", "0 0 0 1\n"}});
  EXPECT_EQ(CtSource(zip(), no_progress, scratch_.path()).path().filename(), "rows.txt");
}

TEST_F(CtSources, ErrorsNameTheArchiveNotItsScratch) {
  make({{"scan/slice.dcm", "no DICOM"}});
  const CtSource source(zip(), no_progress, scratch_.path());
  test::expect_error(ErrorKind::invalid_input, "ct.zip/scan/slice.dcm",
                     [&] { source.read([](const fs::path& path) { return read_ct_files(path); }); });
}

TEST_F(CtSources, CancellingLeavesNothing) {
  series_zip("");
  test::expect_error(ErrorKind::cancelled, "enough", [&] {
    CtSource(
        zip(),
        [](double share, std::string_view) {
          if (share > 0.4) throw Error(ErrorKind::cancelled, "enough");
        },
        scratch_.path());
  });
  EXPECT_TRUE(scratch_.entries().empty());
}

TEST_F(CtSources, WhatHoldsNoSingleCtIsRefused) {
  make({{"letter.pdf", "hello"}});
  expect_refused("no CT");
  make({{"a.nrrd", "x"}, {"b.nrrd", "y"}});
  expect_refused("2 volume files");
  make({{"a.dcm", "x"}, {"b.nrrd", "y"}});
  expect_refused("DICOM slices and volume files");
  make({{"inner.zip", "x"}, {"b.nrrd", "y"}});
  expect_refused("another archive");
}

TEST_F(CtSources, NamesThatLeadOutAreRefused) {
  for (const char* name : {"../evil.dcm", "/tmp/evil.dcm", "a/../../evil.dcm", "a\\..\\evil.dcm"}) {
    make({{name, "x"}});
    expect_refused("leads out of the archive");
  }
  EXPECT_FALSE(fs::exists(scratch_.path().parent_path() / "evil.dcm"));
}

TEST_F(CtSources, LinksAndPasswordsAreRefused) {
  make({{"link.dcm", "/etc/passwd"}});
  change([](zip_t* archive) {
    zip_file_set_external_attributes(archive, 0, 0, ZIP_OPSYS_UNIX, 0120777u << 16);
  });
  expect_refused("is a link");
  make({{"secret.dcm", "x"}});
  change([](zip_t* archive) { zip_file_set_encryption(archive, 0, ZIP_EM_AES_256, "word"); });
  expect_refused("is encrypted");
}

TEST_F(CtSources, BombsAreRefusedBeforeTheyAreUnpacked) {
  make({{"ct.nrrd", std::string(size_t{90} << 20, '\0')}});
  ASSERT_LT(fs::file_size(zip()), size_t{1} << 20);
  expect_refused("larger than may be unpacked");
  // The same with a size that lies: 1000 bytes claimed, in both of the archive's headers.
  std::string bytes = bytes_of(zip());
  const uint32_t real = 90u << 20, claimed = 1000;
  const std::string from(reinterpret_cast<const char*>(&real), 4),
      to(reinterpret_cast<const char*>(&claimed), 4);
  int changed = 0;
  for (size_t at = 0; (at = bytes.find(from, at)) != std::string::npos; ++changed) bytes.replace(at, 4, to);
  EXPECT_GE(changed, 2);
  std::ofstream(zip(), std::ios::binary) << bytes;
  expect_refused("'ct.nrrd' in it");
}

TEST_F(CtSources, TooManyFilesAreRefused) {
  change([](zip_t* archive) {
    for (int i = 0; i < 20001; ++i) {
      zip_source_t* nothing = zip_source_buffer(archive, "", 0, 0);
      ASSERT_GE(zip_file_add(archive, std::to_string(i).c_str(), nothing, 0), 0);
    }
  });
  expect_refused("holds 20001 files");
}

TEST_F(CtSources, DamagedArchivesAreRefused) {
  series_zip("");
  const std::string whole = bytes_of(zip());
  for (const double share : {0.0, 0.01, 0.5, 0.99}) {
    std::ofstream(zip(), std::ios::binary)
        << whole.substr(0, static_cast<size_t>(static_cast<double>(whole.size()) * share));
    expect_refused("ct.zip");
  }
  std::string flipped = whole;
  flipped[200] = static_cast<char>(flipped[200] ^ 0x55);
  std::ofstream(zip(), std::ios::binary) << flipped;
  expect_refused("ct.zip");
  test::expect_error(ErrorKind::not_found, "nowhere.zip", [&] {
    const CtSource source(folder_.path() / "nowhere.zip");
    source.read([](const fs::path& path) { return read_ct_files(path); });
  });
}

}  // namespace
}  // namespace ream::reader
