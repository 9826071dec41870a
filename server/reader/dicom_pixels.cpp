#include "reader/dicom_slice.hpp"

#include <gdcmFragment.h>
#include <gdcmImage.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/error.hpp"

namespace ream::reader {
namespace {

constexpr size_t max_filling_bytes = 64;

unsigned byte_at(std::string_view bytes, size_t at) { return static_cast<unsigned char>(bytes[at]); }
unsigned two_at(std::string_view bytes, size_t at) {
  return byte_at(bytes, at) << 8 | byte_at(bytes, at + 1);
}
uint32_t four_at(std::string_view bytes, size_t at) {
  return uint32_t{two_at(bytes, at)} << 16 | two_at(bytes, at + 2);
}

std::string contradiction(bool fits) { return fits ? "" : "their stream contradicts the header"; }

/// Of a value in memory, as the library unpacks one of so many bits.
int unpacked_bytes_of(unsigned bits) { return bits <= 8 ? 1 : bits <= 16 ? 2 : 4; }

const char* const damaged = "the headers of their stream are damaged";

/// The frame header of JPEG 2000 (SIZ) follows the start at once.
std::string jpeg_2000_problem(std::string_view bytes, int columns, int rows, int bytes_a_value) {
  constexpr size_t header_bytes = 2 + 2 + 38 + 3;
  constexpr unsigned size_marker = 0xff51;
  if (bytes.size() < header_bytes || two_at(bytes, 2) != size_marker) return damaged;
  const uint32_t right = four_at(bytes, 8), bottom = four_at(bytes, 12), left = four_at(bytes, 16),
                 top = four_at(bytes, 20);
  return contradiction(right > left && bottom > top && right - left == static_cast<uint32_t>(columns) &&
                       bottom - top == static_cast<uint32_t>(rows) && two_at(bytes, 40) == 1 &&
                       unpacked_bytes_of((byte_at(bytes, 42) & 0x7f) + 1) == bytes_a_value &&
                       byte_at(bytes, 43) == 1 && byte_at(bytes, 44) == 1);
}

bool starts_frame(unsigned marker) {
  const bool jpeg = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
  return jpeg || marker == 0xf7;
}

constexpr unsigned starts_scan = 0xda;
// Restart, start and end of a picture; and what is reserved, or no marker at all.
constexpr unsigned first_bare = 0xd0, last_bare = 0xd9, first_segment = 0xc0;

/// Of a frame header (SOF) without its marker.
bool is_frame_of(std::string_view segment, int columns, int rows, int bytes_a_value) {
  constexpr size_t one_component = 11;
  if (segment.size() != one_component) return false;
  const unsigned precision = byte_at(segment, 2);
  return precision >= 2 && precision <= 16 && unpacked_bytes_of(precision) == bytes_a_value &&
         two_at(segment, 3) == static_cast<unsigned>(rows) &&
         two_at(segment, 5) == static_cast<unsigned>(columns) && byte_at(segment, 7) == 1;
}

/// Segments (marker, length, content) one after the other up to the scan, a single frame header among them.
/// The library would look for the next marker where one ends, and so read other headers than these.
std::string jpeg_problem(std::string_view bytes, int columns, int rows, int bytes_a_value) {
  size_t at = 2;
  bool has_frame = false;
  while (at + 4 <= bytes.size()) {
    if (byte_at(bytes, at) != 0xff) return damaged;
    const unsigned marker = byte_at(bytes, at + 1);
    if (marker == 0xff) {
      ++at;
      continue;
    }
    // Markers without a length, which no stream has here: the library would read headers within what follows.
    if (marker < first_segment || (marker >= first_bare && marker <= last_bare)) return damaged;
    const size_t length = two_at(bytes, at + 2);
    if (length < 2 || at + 2 + length > bytes.size()) return damaged;
    if (marker == starts_scan) return has_frame ? "" : damaged;
    if (starts_frame(marker)) {
      if (has_frame || !is_frame_of(bytes.substr(at + 2, length), columns, rows, bytes_a_value))
        return contradiction(false);
      has_frame = true;
    }
    at += 2 + length;
  }
  return damaged;
}

constexpr unsigned no_run = 0x80;

/// A segment's runs are of as many values as the picture has; then come only filling bytes.
std::string rle_segment_problem(std::string_view segment, size_t values) {
  size_t at = 0, count = 0;
  while (count < values && at < segment.size()) {
    const unsigned head = byte_at(segment, at++);
    if (head == no_run) continue;
    count += head < no_run ? head + 1 : 257 - head;
    at += head < no_run ? head + 1 : 1;
  }
  if (count < values || at > segment.size()) return "their stream is cut short";
  const bool filled = std::all_of(segment.begin() + static_cast<std::ptrdiff_t>(at), segment.end(),
                                  [](char c) { return c == 0 || static_cast<unsigned char>(c) == no_run; });
  return contradiction(count == values && filled);
}

/// Segments, one for each byte of a value, begin where the header says; little endian.
std::string rle_problem(std::string_view bytes, size_t values, int bytes_a_value) {
  constexpr size_t header_bytes = 64;
  if (bytes.size() < header_bytes) return damaged;
  const auto number = [&](size_t k) {
    return byte_at(bytes, 4 * k) | byte_at(bytes, 4 * k + 1) << 8 | byte_at(bytes, 4 * k + 2) << 16 |
           byte_at(bytes, 4 * k + 3) << 24;
  };
  if (number(0) != static_cast<unsigned>(bytes_a_value)) return contradiction(false);
  size_t last = header_bytes;
  for (size_t k = 1; k <= number(0); ++k) {
    if (number(k) < last || number(k) >= bytes.size() || (k == 1 && number(k) != header_bytes))
      return damaged;
    last = number(k);
  }
  for (size_t k = 1; k <= number(0); ++k) {
    const size_t end = k < number(0) ? number(k + 1) : bytes.size();
    std::string problem = rle_segment_problem(bytes.substr(number(k), end - number(k)), values);
    if (!problem.empty()) return problem;
  }
  return "";
}

/// What keeps a packed picture (JPEG, JPEG-LS, JPEG 2000; or RLE when `rle`) from being one of a single value
/// a pixel, that many columns and rows, and whole; empty when nothing does. Read from the stream's own
/// headers (ITU-T T.81, T.87, T.800), or its runs (DICOM PS3.5 annex G), because the library ends the
/// program, or fills up with what it likes, where they contradict what DICOM says.
std::string packed_frame_problem(std::string_view bytes, int columns, int rows, int bytes_a_value, bool rle) {
  if (rle) return rle_problem(bytes, static_cast<size_t>(columns) * static_cast<size_t>(rows), bytes_a_value);
  const auto tail = bytes.substr(bytes.size() - std::min(bytes.size(), max_filling_bytes));
  if (tail.find("\xff\xd9") == std::string_view::npos) return "their stream is cut short";
  if (bytes.starts_with("\xff\x4f")) return jpeg_2000_problem(bytes, columns, rows, bytes_a_value);
  return bytes.starts_with("\xff\xd8") ? jpeg_problem(bytes, columns, rows, bytes_a_value) : damaged;
}

/// Padding among the values of tissue cannot be told from tissue (some writers state 0 for everything).
constexpr double tissue_low_hu = -200.0, tissue_high_hu = 1500.0;

Error unreadable(const std::filesystem::path& file, const std::string& why) {
  return {ErrorKind::invalid_input, file.string() + ": the pixels cannot be read, " + why};
}

/// The packed pictures, one for each frame; a single frame may come in many fragments.
std::vector<std::string> packed_frames(const DicomSlice& slice, const DicomFile& file) {
  std::vector<std::string> frames;
  for (size_t i = 1; i < file.pixels.size(); ++i) {
    std::string bytes = file.bytes_at(slice.file, file.pixels[i]);
    if (slice.frames == 1 && !frames.empty())
      frames[0] += bytes;
    else
      frames.push_back(std::move(bytes));
  }
  if (frames.size() != static_cast<size_t>(slice.frames))
    throw unreadable(slice.file, "there are not as many frames as the header says");
  return frames;
}

/// The value numbered `i` of stored ones.
int64_t stored_value(const char* from, size_t i, int bits_allocated, bool is_signed) {
  if (bits_allocated == 8)
    return is_signed ? static_cast<signed char>(from[i]) : static_cast<unsigned char>(from[i]);
  if (bits_allocated == 16) {
    uint16_t bits = 0;
    std::memcpy(&bits, from + 2 * i, 2);
    return is_signed ? static_cast<int16_t>(bits) : bits;
  }
  uint32_t bits = 0;
  std::memcpy(&bits, from + 4 * i, 4);
  return is_signed ? static_cast<int64_t>(static_cast<int32_t>(bits)) : bits;
}

}  // namespace

std::vector<char> DicomPixels::plain(const DicomSlice& slice, const DicomFile& file) const {
  const size_t width = static_cast<size_t>(slice.bits_allocated) / 8, bytes = slice.pixels() * width;
  const uint64_t before = static_cast<uint64_t>(slice.frame) * bytes;
  if (file.pixels.size() != 1 || file.pixels[0].bytes < before + bytes)
    throw unreadable(slice.file, "there are fewer than the header says");
  const std::string raw = file.bytes_at(slice.file, {file.pixels[0].at + before, bytes});
  std::vector<char> values(raw.begin(), raw.end());
  if (file.big_endian)
    for (size_t i = 0; i < values.size(); i += width)
      std::reverse(values.begin() + static_cast<std::ptrdiff_t>(i),
                   values.begin() + static_cast<std::ptrdiff_t>(i + width));
  return values;
}

void DicomPixels::unpack(const DicomSlice& slice, const DicomFile& file) {
  unpacked_file_.clear();
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  const gdcm::TransferSyntax syntax(gdcm::TransferSyntax::GetTSType(file.transfer_syntax.c_str()));
  if (syntax == gdcm::TransferSyntax::TS_END || !syntax.IsEncapsulated())
    throw unreadable(slice.file, "they are packed in an unknown way");
  gdcm::SmartPointer<gdcm::SequenceOfFragments> fragments = new gdcm::SequenceOfFragments;
  for (const std::string& frame : packed_frames(slice, file)) {
    const std::string problem =
        packed_frame_problem(frame, slice.columns, slice.rows, slice.bits_allocated / 8,
                             syntax == gdcm::TransferSyntax::RLELossless);
    if (!problem.empty()) throw unreadable(slice.file, problem);
    gdcm::Fragment fragment;
    fragment.SetByteValue(frame.data(), static_cast<uint32_t>(frame.size()));
    fragments->AddFragment(fragment);
  }
  gdcm::DataElement pixels(gdcm::Tag(0x7fe0, 0x0010), 0, gdcm::VR::OB);
  pixels.SetValue(*fragments);
  const auto bits = static_cast<unsigned short>(slice.bits_allocated),
             stored = static_cast<unsigned short>(slice.bits_stored);
  gdcm::Image image;
  image.SetNumberOfDimensions(slice.frames > 1 ? 3 : 2);
  image.SetDimension(0, static_cast<unsigned>(slice.columns));
  image.SetDimension(1, static_cast<unsigned>(slice.rows));
  if (slice.frames > 1) image.SetDimension(2, static_cast<unsigned>(slice.frames));
  image.SetPixelFormat(
      gdcm::PixelFormat(1, bits, stored, static_cast<unsigned short>(stored - 1), slice.is_signed));
  image.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
  image.SetTransferSyntax(syntax);
  image.SetDataElement(pixels);
  const size_t bytes = slice.pixels() * static_cast<size_t>(slice.frames) * (bits / 8u);
  if (image.GetBufferLength() != bytes)
    throw unreadable(slice.file, "they are not as many as the header says");
  unpacked_.assign(bytes, 0);
  if (!image.GetBuffer(unpacked_.data())) throw unreadable(slice.file, "their packed stream is damaged");
  unpacked_file_ = slice.file;
}

std::vector<int16_t> DicomPixels::hu(const DicomSlice& slice) {
  const size_t count = slice.pixels();
  std::vector<char> own;
  const char* from = nullptr;
  const DicomFile file = unpacked_file_ == slice.file ? DicomFile{} : parse_dicom(slice.file);
  if (unpacked_file_ != slice.file && !file.packed) {
    own = plain(slice, file);
    from = own.data();
  } else {
    if (unpacked_file_ != slice.file) unpack(slice, file);
    from = unpacked_.data() +
           static_cast<size_t>(slice.frame) * count * static_cast<size_t>(slice.bits_allocated / 8);
  }
  const double padding_hu = slice.padding ? slice.slope * *slice.padding + slice.intercept : 0.0;
  const bool padded = slice.padding && (padding_hu < tissue_low_hu || padding_hu > tissue_high_hu);
  const auto [pad_low, pad_high] =
      std::minmax({padded ? *slice.padding : 0, padded ? slice.padding_limit.value_or(*slice.padding) : 0});
  // Negative values narrower than their place may come without their leading ones.
  const int64_t sign_bit = int64_t{1} << (slice.bits_stored - 1);
  std::vector<int16_t> hu(count);
  for (size_t i = 0; i < count; ++i) {
    int64_t stored = stored_value(from, i, slice.bits_allocated, slice.is_signed);
    if (slice.is_signed && stored >= sign_bit && stored < 2 * sign_bit) stored -= 2 * sign_bit;
    const double value = std::floor(slice.slope * static_cast<double>(stored) + slice.intercept + 0.5);
    const bool outside = value < ct::min_hu || (padded && stored >= pad_low && stored <= pad_high);
    outside_ += outside;
    hu[i] = outside ? ct::min_hu : value >= 32767.0 ? int16_t{32767} : static_cast<int16_t>(value);
  }
  return hu;
}

}  // namespace ream::reader
