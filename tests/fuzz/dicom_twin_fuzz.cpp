// Well-formed DICOM slices of any content, read by us and by GDCM: both must see the same picture in the same
// place.
#include <gdcmImageReader.h>
#include <gdcmTrace.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "core/error.hpp"
#include "fuzz_file.hpp"
#include "reader/dicom_file.hpp"
#include "reader/dicom_slice.hpp"

namespace ream::fuzz {
namespace {

/// Writes data elements (DICOM PS3.5, chapter 7).
class Writer {
 public:
  Writer(bool implicit, bool big_endian) : implicit_(implicit), big_endian_(big_endian) {}

  void number(uint64_t value, int bytes) {
    for (int k = 0; k < bytes; ++k)
      bytes_ += static_cast<char>(value >> 8 * (big_endian_ ? bytes - 1 - k : k) & 0xff);
  }
  void head(uint32_t tag, const char* vr, uint64_t length) {
    number(tag >> 16, 2);
    number(tag & 0xffff, 2);
    if (implicit_) return number(length, 4);
    bytes_ += vr;
    const std::string_view name = vr;
    if (name == "OB" || name == "OW" || name == "SQ" || name == "UN") {
      number(0, 2);
      number(length, 4);
    } else {
      number(length, 2);
    }
  }
  void text(uint32_t tag, const char* vr, std::string value) {
    if (value.size() % 2 != 0) value += std::string_view(vr) == "UI" ? '\0' : ' ';
    head(tag, vr, value.size());
    bytes_ += value;
  }
  void short_number(uint32_t tag, uint64_t value, const char* vr = "US") {
    head(tag, vr, 2);
    number(value, 2);
  }
  /// A sequence of one item, whose elements `fill` writes; lengths are said or left open.
  template <typename Fill>
  void sequence(uint32_t tag, bool open, Fill fill) {
    Writer item(implicit_, big_endian_);
    fill(item);
    constexpr uint32_t undefined = 0xffffffff;
    head(tag, "SQ", open ? undefined : 8 + item.bytes_.size());
    mark(0xfffee000, open ? undefined : static_cast<uint32_t>(item.bytes_.size()));
    bytes_ += item.bytes_;
    if (!open) return;
    mark(0xfffee00d, 0);
    mark(0xfffee0dd, 0);
  }
  void raw(const std::string& bytes) { bytes_ += bytes; }
  const std::string& bytes() const { return bytes_; }

 private:
  void mark(uint32_t tag, uint32_t length) {
    number(tag >> 16, 2);
    number(tag & 0xffff, 2);
    number(length, 4);
  }

  bool implicit_, big_endian_;
  std::string bytes_;
};

/// A decimal string, in one of the ways in which people write it.
std::string decimal(Input& input, bool positive = false) {
  double value = static_cast<int8_t>(input.byte()) * 0.37 + static_cast<int8_t>(input.byte()) * 12.5;
  if (positive) value = std::abs(value) + 0.25;
  const char* const forms[] = {"%.4f", "%.6g", "%.3e", "%+.4f", " %.4f", "%.4f  "};
  char text[32];
  std::snprintf(text, sizeof text, forms[input.byte() % std::size(forms)], value);
  return text;
}

/// What must not be taken for the slice's own.
void decoys(Writer& writer) {
  writer.text(0x0020000e, "UI", "1.2.3.4");
  writer.text(0x00200032, "DS", "1\\2\\3");
  writer.short_number(0x00280010, 99);
  writer.short_number(0x00280011, 77);
  writer.text(0x00281053, "DS", "5");
}

struct Syntax {
  const char* uid;
  bool implicit, big_endian;
};
constexpr Syntax syntaxes[] = {{"1.2.840.10008.1.2", true, false},
                               {"1.2.840.10008.1.2.1", false, false},
                               {"1.2.840.10008.1.2.2", false, true}};
const char* const axes[] = {"1\\0\\0\\0\\1\\0", "0.6\\0.8\\0\\-0.8\\0.6\\0", "0\\1\\0\\0\\0\\-1",
                            "1\\0\\0\\0\\0.8\\-0.6"};

std::string meta_group(const char* syntax) {
  Writer rest(false, false);
  rest.text(0x00020002, "UI", "1.2.840.10008.5.1.4.1.1.2");
  rest.text(0x00020003, "UI", "1.2.3.4.5");
  rest.text(0x00020010, "UI", syntax);
  Writer group(false, false);
  group.head(0x00020000, "UL", 4);
  group.number(rest.bytes().size(), 4);
  return std::string(128, '\0') + "DICM" + group.bytes() + rest.bytes();
}

/// A slice as the input wants it.
std::string slice_of(Input& input) {
  const Syntax& syntax = syntaxes[input.byte() % std::size(syntaxes)];
  const uint8_t extras = input.byte();
  const int rows = 1 + input.byte() % 9, columns = 1 + input.byte() % 9;
  const int allocated = input.byte() % 3 == 0 ? 8 : 16;
  const int stored = allocated == 16 && (extras & 1) ? 12 : allocated;
  const bool is_signed = extras & 2;
  Writer writer(syntax.implicit, syntax.big_endian);
  if (extras & 4) writer.text(0x00080005, "CS", "ISO_IR 100");
  writer.text(0x00080008, "CS", "ORIGINAL\\PRIMARY\\AXIAL");
  writer.text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2");
  writer.text(0x00080018, "UI", "1.2.3.4.5");
  writer.text(0x00080060, "CS", "CT");
  if (extras & 8) writer.sequence(0x00081140, extras & 16, decoys);
  if (extras & 32) {
    writer.text(0x00090010, "LO", "SOMEBODY");
    writer.text(0x00091001, "LO", std::string(input.piece().substr(0, 64)));
  }
  writer.text(0x00180050, "DS", decimal(input, true));
  writer.text(0x0020000d, "UI", "1.2.3");
  writer.text(0x0020000e, "UI", "1.2.3." + std::to_string(input.byte()));
  writer.text(0x00200013, "IS", std::to_string(input.byte()));
  writer.text(0x00200032, "DS", decimal(input) + "\\" + decimal(input) + "\\" + decimal(input));
  writer.text(0x00200037, "DS", axes[input.byte() % std::size(axes)]);
  writer.short_number(0x00280002, 1);
  writer.text(0x00280004, "CS", extras & 64 ? "MONOCHROME1" : "MONOCHROME2");
  writer.short_number(0x00280010, static_cast<uint64_t>(rows));
  writer.short_number(0x00280011, static_cast<uint64_t>(columns));
  writer.text(0x00280030, "DS", decimal(input, true) + "\\" + decimal(input, true));
  writer.short_number(0x00280100, static_cast<uint64_t>(allocated));
  writer.short_number(0x00280101, static_cast<uint64_t>(stored));
  writer.short_number(0x00280102, static_cast<uint64_t>(stored - 1));
  writer.short_number(0x00280103, is_signed);
  writer.text(0x00281052, "DS", decimal(input));
  writer.text(0x00281053, "DS", decimal(input, true));
  writer.text(0x00281054, "LO", "HU");
  if (extras & 128) writer.sequence(0x00400275, !(extras & 16), decoys);
  Writer pixels(syntax.implicit, syntax.big_endian);
  for (int i = 0; i < rows * columns; ++i) {
    const int wide = input.byte() | input.byte() << 8;
    const int value =
        is_signed ? static_cast<int16_t>(wide << (16 - stored)) >> (16 - stored) : wide & ((1 << stored) - 1);
    pixels.number(static_cast<uint64_t>(value), allocated / 8);
  }
  if (pixels.bytes().size() % 2 != 0) pixels.number(0, 1);
  writer.head(0x7fe00010, allocated == 8 && !syntax.implicit ? "OB" : "OW", pixels.bytes().size());
  writer.raw(pixels.bytes());
  return meta_group(syntax.uid) + writer.bytes();
}

bool near(double a, double b) { return std::abs(a - b) <= 1e-9 * (1.0 + std::abs(b)); }

void require_same_place(const reader::DicomSlice& ours, const gdcm::Image& theirs) {
  require(ours.columns == static_cast<int>(theirs.GetDimension(0)) &&
              ours.rows == static_cast<int>(theirs.GetDimension(1)),
          "sizes differ");
  for (unsigned k = 0; k < 3; ++k) {
    require(near(ours.origin_mm[k], theirs.GetOrigin(k)), "places differ");
    require(near(ours.along_row[k], theirs.GetDirectionCosines(k)) &&
                near(ours.along_column[k], theirs.GetDirectionCosines(3 + k)),
            "axes differ");
  }
  require(near(ours.spacing_mm.x(), theirs.GetSpacing(0)) && near(ours.spacing_mm.y(), theirs.GetSpacing(1)),
          "pixel sizes differ");
  require(near(ours.slope, theirs.GetSlope()) && near(ours.intercept, theirs.GetIntercept()),
          "scales differ");
  const gdcm::PixelFormat& format = theirs.GetPixelFormat();
  require(ours.bits_allocated == format.GetBitsAllocated() && ours.bits_stored == format.GetBitsStored() &&
              ours.is_signed == (format.GetPixelRepresentation() == 1),
          "pixel formats differ");
}

void require_same_values(const reader::DicomSlice& slice, const gdcm::Image& theirs) {
  std::vector<char> bytes(theirs.GetBufferLength());
  require(theirs.GetBuffer(bytes.data()), "the library cannot read the pixels");
  reader::DicomPixels pixels;
  const std::vector<int16_t> ours = pixels.hu(slice);
  const size_t width = static_cast<size_t>(slice.bits_allocated) / 8;
  require(bytes.size() == ours.size() * width, "numbers of pixels differ");
  for (size_t i = 0; i < ours.size(); ++i) {
    uint16_t raw = 0;
    std::memcpy(&raw, bytes.data() + i * width, width);
    const int shift = 32 - slice.bits_stored;
    const auto left = static_cast<uint32_t>(raw) << shift;
    const double value = slice.is_signed ? static_cast<double>(static_cast<int32_t>(left) >> shift)
                                         : static_cast<double>(left >> shift);
    const double hu = std::floor(slice.slope * value + slice.intercept + 0.5);
    require(ours[i] == (hu < ct::min_hu ? ct::min_hu : std::min(hu, 32767.0)), "values differ");
  }
}

}  // namespace
}  // namespace ream::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ream;
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  fuzz::Input input(data, size);
  const auto path = fuzz::folder().write("slice.dcm", fuzz::slice_of(input));
  const reader::DicomFile file = reader::parse_dicom(path);
  fuzz::require(file.state == reader::DicomState::whole, "a whole file is taken for a damaged one");
  const auto slices = reader::describe_dicom(path, file);
  fuzz::require(slices.size() == 1 && slices[0].unusable.empty(), "a slice is taken for none");
  gdcm::ImageReader library;
  library.SetFileName(path.c_str());
  fuzz::require(library.Read(), "the library cannot read the file");
  fuzz::require_same_place(slices[0], library.GetImage());
  fuzz::require_same_values(slices[0], library.GetImage());
  return 0;
}
