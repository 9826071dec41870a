#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "core/error.hpp"
#include "core/file.hpp"
#include "ct/read/read_ct.hpp"
#include "ct/read/write_volume.hpp"
#include "store/zip_archive.hpp"
#include "support/seed.hpp"
#include "support/temporary_folder.hpp"
#include "unit/reader/changed_dicom.hpp"

namespace ream::ct {
namespace {

namespace fs = std::filesystem;
using Syntax = gdcm::TransferSyntax;

constexpr int packed_slices = 3, packed_columns = 48, packed_rows = 40;

HuVolume packed_volume() {
  HuVolume volume;
  volume.dims = {packed_columns, packed_rows, packed_slices};
  for (int i = 0; i < packed_columns * packed_rows * packed_slices; ++i)
    volume.hu.push_back(static_cast<int16_t>(i * 37 % 1900 - 900));
  return volume;
}

/// Slices whose packed stream says something else than their header: a library that takes the header's word
/// writes beyond its memory (a JPEG 2000 stream of 16 bits a pixel into a slice of 8).
class HostileCodec : public testing::TestWithParam<Syntax::TSType> {
 protected:
  void SetUp() override {
    write_dicom_folder(packed_volume(), folder_.path(), 1);
    for (int i = 1; i <= packed_slices; ++i) test::transcode(slice(i), GetParam());
  }
  fs::path slice(int number) const { return test::slice_file(folder_.path(), number); }

  /// What reading says: nothing where it went well. This process lives on whatever the reader does.
  std::string said_of(const fs::path& path) const {
    try {
      read_ct(path);
      return "";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::invalid_input) << error.what();
      const std::string words = error.what();
      EXPECT_EQ(words.find('\n'), std::string::npos) << words;
      EXPECT_NE(words.find(path.string()), std::string::npos) << words;
      return words;
    }
  }
  void expect_refused(const std::function<void(gdcm::DataSet&)>& change) {
    for (int i = 1; i <= packed_slices; ++i) test::change_dicom(slice(i), change);
    const std::string said = said_of(folder_.path());
    EXPECT_FALSE(said.empty());
    EXPECT_EQ(said.find("crashed"), std::string::npos) << said;
    fs::remove_all(folder_.path());
    fs::create_directories(folder_.path());
    SetUp();
  }
  /// Where the packed stream of the first slice lies: behind its table and the head of its fragment.
  static size_t stream_in(const std::string& bytes) {
    const std::string item("\xfe\xff\x00\xe0", 4);
    return bytes.find(item, bytes.find(item) + 4) + 8;
  }

  test::TemporaryFolder folder_;
};

TEST_P(HostileCodec, IsReadAsItIs) {
  EXPECT_EQ(said_of(folder_.path()), "");
  EXPECT_EQ(read_ct(folder_.path()).hu, packed_volume().hu);
}

TEST_P(HostileCodec, ThatContradictsItsHeaderIsRefused) {
  for (const int bits : {8, 32})
    expect_refused([&](gdcm::DataSet& set) {
      test::put_number(set, 0x0028, 0x0100, bits);
      test::put_number(set, 0x0028, 0x0101, bits);
      test::put_number(set, 0x0028, 0x0102, bits - 1);
    });
  if (GetParam() == Syntax::RLELossless) return;  // its stream does not say how large its picture is
  for (const int side : {1, packed_rows - 1, packed_rows + 1, 200})
    expect_refused([&](gdcm::DataSet& set) { test::put_number(set, 0x0028, 0x0010, side); });
  expect_refused([&](gdcm::DataSet& set) {
    test::put_number(set, 0x0028, 0x0010, packed_columns);
    test::put_number(set, 0x0028, 0x0011, packed_rows);
  });
}

TEST_P(HostileCodec, OfAnotherKindThanItsHeaderSaysIsRefused) {
  const std::string packed = read_text_file(slice(1));
  const auto uid = [](Syntax::TSType syntax) { return std::string(Syntax::GetTSString(syntax)); };
  for (const auto other : {Syntax::JPEG2000Lossless, Syntax::JPEGLSLossless, Syntax::RLELossless,
                           Syntax::JPEGLosslessProcess14_1}) {
    const std::string from = uid(GetParam()), to = uid(other);
    if (from == to || from.size() < to.size()) continue;
    std::string bytes = packed;
    bytes.replace(bytes.find(from), from.size(), to + std::string(from.size() - to.size(), '\0'));
    write_file_atomically(slice(1), bytes);
    EXPECT_NE(said_of(folder_.path()), "") << from << " as " << to;
  }
}

TEST_P(HostileCodec, WithDamagedHeadersOfItsStreamEndsInOneLine) {
  const std::string packed = read_text_file(slice(1));
  const size_t stream = stream_in(packed);
  ASSERT_LT(stream + 200, packed.size());
  uint64_t random = test::seed(2026);
  for (int round = 0; round < 20; ++round) {
    std::string bytes = packed;
    for (int k = 0; k < 2; ++k) {
      random = random * 6364136223846793005u + 1442695040888963407u;
      bytes[stream + (random >> 33) % 100] = static_cast<char>(random >> 20);
    }
    write_file_atomically(slice(1), bytes);
    said_of(folder_.path());
    const fs::path zip = folder_.path() / "ct.zip";
    store::write_zip(zip, {{slice(1), "a.dcm"}, {slice(2), "b.dcm"}, {slice(3), "c.dcm"}});
    if (round % 5 == 0) said_of(zip);
    fs::remove(zip);
  }
}

INSTANTIATE_TEST_SUITE_P(Packed, HostileCodec,
                         testing::Values(Syntax::JPEG2000Lossless, Syntax::JPEGLSLossless,
                                         Syntax::JPEGLosslessProcess14_1, Syntax::RLELossless),
                         [](const auto& syntax) {
                           std::string name = Syntax::GetTSString(syntax.param);
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

TEST(HostileArchive, WithinAnArchiveByWhateverNameIsRefused) {
  const test::TemporaryFolder folder;
  const fs::path inner = folder.path() / "inner.zip", outer = folder.path() / "outer.zip";
  store::write_zip(inner, {{folder.write("slice.dcm", "x"), "slice.dcm"}});
  for (const char* name : {"inner.zip", "INNER.ZIP", "slice.dcm", "ct", "ct.nii", "rows.txt"}) {
    store::write_zip(outer, {{inner, name}});
    try {
      read_ct(outer);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("outer.zip holds another archive"), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace ream::ct
