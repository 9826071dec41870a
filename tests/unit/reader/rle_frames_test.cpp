#include <gdcmSequenceOfFragments.h>
#include <gtest/gtest.h>

#include "ct/read/write_volume.hpp"
#include "reader/ct_files.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "unit/reader/changed_dicom.hpp"

namespace ream::reader {
using namespace ct;
namespace {

using test::slice_file;

constexpr int rle_columns = 32, rle_rows = 24, rle_pixels = rle_columns * rle_rows;
constexpr size_t header_bytes = 64;

int16_t value_of(int pixel) { return static_cast<int16_t>((37 * pixel) % 1500 - 500); }

/// One byte of every pixel as literal runs of 128 (DICOM PS3.5 annex G).
std::string rle_segment(int shift, int count = rle_pixels) {
  std::string packed;
  for (int begin = 0; begin < count; begin += 128) {
    const int length = std::min(128, count - begin);
    packed += static_cast<char>(length - 1);
    for (int i = begin; i < begin + length; ++i)
      packed += static_cast<char>(static_cast<uint16_t>(value_of(i)) >> shift & 0xff);
  }
  return packed;
}

std::string header(const std::vector<uint32_t>& numbers) {
  std::string bytes(header_bytes, '\0');
  for (size_t i = 0; i < numbers.size(); ++i)
    for (int k = 0; k < 4; ++k)
      bytes[4 * i + static_cast<size_t>(k)] = static_cast<char>(numbers[i] >> 8 * k);
  return bytes;
}

/// The high bytes, then the low ones.
std::string frame_of(const std::string& high, const std::string& low) {
  return header({2, header_bytes, static_cast<uint32_t>(header_bytes + high.size())}) + high + low;
}

/// A series of two RLE slices; the frame of the second one is replaced.
class RleFrames : public testing::Test {
 protected:
  RleFrames() {
    HuVolume volume;
    volume.dims = {rle_columns, rle_rows, 2};
    for (int i = 0; i < 2 * rle_pixels; ++i) volume.hu.push_back(value_of(i % rle_pixels));
    write_dicom_folder(volume, folder_.path(), 1);
    for (int i = 1; i <= 2; ++i)
      test::transcode(slice_file(folder_.path(), i), gdcm::TransferSyntax::RLELossless);
  }
  void put(std::string frame) {
    if (frame.size() % 2 != 0) frame += '\0';
    test::change_dicom(slice_file(folder_.path(), 2), [&](gdcm::DataSet& set) {
      gdcm::SmartPointer<gdcm::SequenceOfFragments> fragments = new gdcm::SequenceOfFragments;
      gdcm::Fragment fragment;
      fragment.SetByteValue(frame.data(), static_cast<uint32_t>(frame.size()));
      fragments->AddFragment(fragment);
      gdcm::DataElement packed = set.GetDataElement(gdcm::Tag(0x7fe0, 0x0010));
      packed.SetValue(*fragments);
      set.Replace(packed);
    });
  }
  void expect_read(const std::string& frame) {
    put(frame);
    const HuVolume volume = read_ct_files(folder_.path());
    for (int i = 0; i < rle_pixels; ++i)
      ASSERT_EQ(volume.hu[static_cast<size_t>(rle_pixels + i)], value_of(i)) << i;
  }
  void expect_refused(const std::string& frame) {
    put(frame);
    test::expect_error(ErrorKind::invalid_input, "slice_0002.dcm: the pixels cannot be read",
                       [&] { read_ct_files(folder_.path()); });
  }

  test::TemporaryFolder folder_;
  const std::string high_ = rle_segment(8), low_ = rle_segment(0);
};

TEST_F(RleFrames, WholeOnesAreRead) {
  expect_read(frame_of(high_, low_));
  expect_read(frame_of(high_ + '\0', low_));    // filled up to an even length
  expect_read(frame_of(high_, "\x80" + low_));  // a run that means nothing
  expect_read(frame_of(high_, low_) + std::string(2, '\0'));
}

TEST_F(RleFrames, ThoseTooShortAreRefused) {
  for (const size_t bytes : {size_t{2}, size_t{3}, size_t{130}, low_.size() / 2, low_.size()}) {
    SCOPED_TRACE(bytes);
    expect_refused(frame_of(high_, low_.substr(0, low_.size() - bytes)));
  }
  expect_refused(frame_of(rle_segment(8, rle_pixels - 128), low_));
  expect_refused(frame_of(high_, rle_segment(0, rle_pixels - 1)));
  expect_refused(frame_of(high_, low_).substr(0, header_bytes));
  expect_refused(frame_of(high_, low_).substr(0, header_bytes - 2));
  expect_refused("");
}

TEST_F(RleFrames, ThoseTooLongAreRefused) {
  expect_refused(frame_of(rle_segment(8, rle_pixels + 128), low_));
  expect_refused(frame_of(high_, rle_segment(0, rle_pixels + 1)));
  expect_refused(frame_of(high_, rle_segment(0, 3 * rle_pixels)));
  expect_refused(frame_of(high_, low_ + std::string("\x81\x01", 2)));
}

TEST_F(RleFrames, OddTablesOfSegmentsAreRefused) {
  const std::string segments = high_ + low_;
  const auto second = static_cast<uint32_t>(header_bytes + high_.size());
  const auto end = static_cast<uint32_t>(header_bytes + segments.size());
  for (const std::vector<uint32_t>& table : {std::vector<uint32_t>{0},
                                             {1, 64},
                                             {3, 64, second, second + 128},
                                             {16, 64, second},
                                             {0xffffffff, 64, second},
                                             {2, 0, second},
                                             {2, 63, second},
                                             {2, 66, second},
                                             {2, second, 64},
                                             {2, 64, 64},
                                             {2, 64, 65},
                                             {2, 64, second - 129},
                                             {2, 64, second + 129},
                                             {2, 64, end},
                                             {2, 64, end - 1},
                                             {2, 64, 0},
                                             {2, 64, 0xffffffff},
                                             {2, 64, 0x80000000}}) {
    SCOPED_TRACE(testing::PrintToString(table));
    expect_refused(header(table) + segments);
  }
}

}  // namespace
}  // namespace ream::reader
