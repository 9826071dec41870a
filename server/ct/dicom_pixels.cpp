#include <gdcmImageReader.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

#include "core/error.hpp"
#include "ct/dicom_slice.hpp"

namespace ream::ct {
namespace {

/// Padding among the values of tissue cannot be told from tissue (some writers state 0 for everything).
constexpr double tissue_low_hu = -200.0, tissue_high_hu = 1500.0;

Error unreadable(const std::filesystem::path& file, const char* why) {
  return {ErrorKind::invalid_input, file.string() + ": the pixels cannot be read, " + why};
}

/// JPEG, JPEG-LS and JPEG 2000 streams end with the marker FFD9; without it the library fills up with what it
/// likes.
bool ends_with_marker(const gdcm::Image& image) {
  const gdcm::TransferSyntax& syntax = image.GetTransferSyntax();
  const gdcm::SequenceOfFragments* fragments = image.GetDataElement().GetSequenceOfFragments();
  if (fragments == nullptr || syntax == gdcm::TransferSyntax::RLELossless) return true;
  if (fragments->GetNumberOfFragments() == 0) return false;
  const gdcm::ByteValue* last = fragments->GetFragment(fragments->GetNumberOfFragments() - 1).GetByteValue();
  if (last == nullptr) return false;
  const std::string_view bytes(last->GetPointer(), last->GetLength());
  constexpr size_t longest_filling = 64;
  return bytes.substr(bytes.size() - std::min(bytes.size(), longest_filling)).find("\xff\xd9") !=
         std::string_view::npos;
}

}  // namespace

void DicomPixels::decode(const DicomSlice& slice) {
  file_.clear();
  bytes_ = {};
  gdcm::ImageReader reader;
  reader.SetFileName(slice.file.c_str());
  if (!reader.Read()) throw unreadable(slice.file, "they are damaged or packed in an unknown way");
  const gdcm::Image& image = reader.GetImage();
  const gdcm::PixelFormat& format = image.GetPixelFormat();
  if (image.GetNumberOfDimensions() < 2 || image.GetDimension(0) != static_cast<unsigned>(slice.columns) ||
      image.GetDimension(1) != static_cast<unsigned>(slice.rows) || format.GetSamplesPerPixel() != 1)
    throw unreadable(slice.file, "they are not as many as the header says");
  bytes_a_value_ = format.GetBitsAllocated() / 8;
  bits_stored_ = format.GetBitsStored();
  is_signed_ = format.GetPixelRepresentation() == 1;
  const bool whole = bytes_a_value_ == 1 || bytes_a_value_ == 2 || bytes_a_value_ == 4;
  if (!whole) throw unreadable(slice.file, "they are not of 8, 16 or 32 bits");
  // The library takes pixels that are not there for zeros.
  const gdcm::ByteValue* plain = image.GetDataElement().GetByteValue();
  if (plain != nullptr && plain->GetLength() < image.GetBufferLength())
    throw unreadable(slice.file, "there are fewer pixels than the header says");
  if (!ends_with_marker(image)) throw unreadable(slice.file, "their packed stream is cut short");
  bytes_.assign(image.GetBufferLength(), 0);
  if (bytes_.size() < slice.pixels() * static_cast<size_t>(bytes_a_value_) || !image.GetBuffer(bytes_.data()))
    throw unreadable(slice.file, "they are damaged or cut short");
  file_ = slice.file;
}

std::vector<int16_t> DicomPixels::hu(const DicomSlice& slice) {
  if (file_ != slice.file) decode(slice);
  const size_t count = slice.pixels(), width = static_cast<size_t>(bytes_a_value_);
  if (bytes_.size() < (static_cast<size_t>(slice.frame) + 1) * count * width)
    throw unreadable(slice.file, "there are fewer frames than the header says");
  const char* from = bytes_.data() + static_cast<size_t>(slice.frame) * count * width;
  // Negative values narrower than their place may come without their leading ones.
  const int64_t sign_bit = int64_t{1} << (bits_stored_ - 1);
  const double padding_hu = slice.padding ? slice.slope * *slice.padding + slice.intercept : 0.0;
  const bool padded = slice.padding && (padding_hu < tissue_low_hu || padding_hu > tissue_high_hu);
  const int64_t pad_a = padded ? *slice.padding : 0,
                pad_b = padded ? slice.padding_limit.value_or(*slice.padding) : 0;
  const int64_t pad_low = std::min(pad_a, pad_b), pad_high = std::max(pad_a, pad_b);
  std::vector<int16_t> hu(count);
  for (size_t i = 0; i < count; ++i) {
    int64_t stored = 0;
    if (width == 1) {
      stored = is_signed_ ? static_cast<signed char>(from[i]) : static_cast<unsigned char>(from[i]);
    } else if (width == 2) {
      uint16_t bits = 0;
      std::memcpy(&bits, from + 2 * i, 2);
      stored = is_signed_ ? static_cast<int16_t>(bits) : bits;
    } else {
      uint32_t bits = 0;
      std::memcpy(&bits, from + 4 * i, 4);
      stored = is_signed_ ? static_cast<int64_t>(static_cast<int32_t>(bits)) : bits;
    }
    if (is_signed_ && stored >= sign_bit && stored < 2 * sign_bit) stored -= 2 * sign_bit;
    const double value = std::floor(slice.slope * static_cast<double>(stored) + slice.intercept + 0.5);
    const bool outside = value < min_hu || (padded && stored >= pad_low && stored <= pad_high);
    outside_ += outside;
    hu[i] = outside ? min_hu : value >= 32767.0 ? int16_t{32767} : static_cast<int16_t>(value);
  }
  return hu;
}

}  // namespace ream::ct
