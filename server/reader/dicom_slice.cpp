#include "reader/dicom_slice.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/error.hpp"
#include "reader/standard_terms.hpp"

namespace ream::reader {
namespace fs = std::filesystem;
namespace {

constexpr int max_side = 8192;          // the largest clinical matrix is 2048
constexpr double room_bytes = 8 << 20;  // a small packed file may still be one plain picture
constexpr double max_packing = 1000.0;  // beyond any coder on a real picture
constexpr double max_frames = 1e5;
constexpr double perpendicular_tolerance = 1e-3;

constexpr uint32_t tag_of(uint16_t group, uint16_t element) { return uint32_t{group} << 16 | element; }

std::string bytes_of(const DicomSet& set, uint16_t group, uint16_t element) {
  const auto found = set.values.find(tag_of(group, element));
  return found == set.values.end() ? "" : found->second;
}

std::string trimmed(std::string text) {
  const auto blank = [](char c) { return c == ' ' || c == '\0'; };
  while (!text.empty() && blank(text.back())) text.pop_back();
  text.erase(text.begin(), std::find_if_not(text.begin(), text.end(), blank));
  return text;
}

std::string text_of(const DicomSet& set, uint16_t group, uint16_t element) {
  return trimmed(bytes_of(set, group, element));
}

/// Text for JSON and pages: Latin-1 becomes UTF-8, other alphabets become question marks.
std::string readable(const std::string& text, const std::string& character_set) {
  const bool latin = character_set == "ISO_IR 100" || character_set.ends_with("\\ISO 2022 IR 100");
  std::string result;
  for (const char c : text.substr(0, 128)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) continue;
    if (byte < 0x80) {
      result += c;
    } else if (latin && byte >= 0xa0) {
      result += static_cast<char>(0xc0 | (byte >> 6));
      result += static_cast<char>(0x80 | (byte & 0x3f));
    } else {
      result += '?';
    }
  }
  return result;
}

/// The numbers of a decimal string, NaN for what is none.
std::vector<double> decimals(const DicomSet& set, uint16_t group, uint16_t element) {
  const std::string text = text_of(set, group, element);
  std::vector<double> numbers;
  if (text.empty()) return numbers;
  for (size_t start = 0; start <= text.size();) {
    const size_t end = std::min(text.find('\\', start), text.size());
    std::string word = trimmed(text.substr(start, end - start));
    if (word.starts_with('+')) word.erase(0, 1);
    double number = 0.0;
    const auto parsed = std::from_chars(word.data(), word.data() + word.size(), number);
    numbers.push_back(parsed.ec == std::errc() ? number : std::nan(""));
    start = end + 1;
  }
  return numbers;
}

std::optional<int> whole_number(const DicomSet& set, uint16_t group, uint16_t element) {
  const std::string bytes = bytes_of(set, group, element);
  if (bytes.size() < 2) return {};
  return static_cast<unsigned char>(bytes[0]) | static_cast<unsigned char>(bytes[1]) << 8;
}

constexpr uint32_t frames_own = 0x52009230, frames_shared = 0x52009229;
constexpr uint32_t position_macro = 0x00209113, orientation_macro = 0x00209116, measures_macro = 0x00289110,
                   values_macro = 0x00289145;

const DicomSet* item_of(const DicomSet& set, uint32_t sequence, size_t number) {
  const auto found = set.sequences.find(sequence);
  return found == set.sequences.end() || number >= found->second.size() ? nullptr : &found->second[number];
}

/// Where a frame's own attributes lie in a file of many frames (DICOM PS3.3, C.7.6.16): in its functional
/// groups, or in those that all frames share. In a file of one slice: in the data set itself.
class Attributes {
 public:
  Attributes(const DicomSet& file, int frame)
      : places_{item_of(file, frames_own, static_cast<size_t>(frame)), item_of(file, frames_shared, 0)},
        file_(file) {}

  std::vector<double> numbers(uint32_t macro, uint16_t group, uint16_t element) const {
    return decimals(holder(macro, group, element), group, element);
  }
  std::string text(uint32_t macro, uint16_t group, uint16_t element) const {
    return text_of(holder(macro, group, element), group, element);
  }

 private:
  const DicomSet& holder(uint32_t macro, uint16_t group, uint16_t element) const {
    for (const DicomSet* place : places_) {
      const DicomSet* inner = place == nullptr ? nullptr : item_of(*place, macro, 0);
      if (inner != nullptr && inner->values.contains(tag_of(group, element))) return *inner;
    }
    return file_;
  }

  std::array<const DicomSet*, 2> places_;
  const DicomSet& file_;
};

void read_place(DicomSlice& slice, const Attributes& attributes) {
  const auto place = attributes.numbers(position_macro, 0x0020, 0x0032),
             axes = attributes.numbers(orientation_macro, 0x0020, 0x0037),
             size = attributes.numbers(measures_macro, 0x0028, 0x0030),
             thickness = attributes.numbers(measures_macro, 0x0018, 0x0050);
  if (place.size() != 3 || axes.size() != 6 || size.size() != 2) {
    slice.unusable = "without position, orientation or pixel size";
    return;
  }
  slice.origin_mm = {place[0], place[1], place[2]};
  slice.along_row = {axes[0], axes[1], axes[2]};
  slice.along_column = {axes[3], axes[4], axes[5]};
  slice.spacing_mm = {size[1], size[0], thickness.empty() ? 0.0 : thickness[0]};
  if (!std::isfinite(slice.spacing_mm.z()) || slice.spacing_mm.z() < 0.0) slice.spacing_mm.z() = 0.0;
  const auto off = [](double v) { return !(std::abs(v) < perpendicular_tolerance); };
  if (!slice.spacing_mm.allFinite() || !(slice.spacing_mm.head<2>().minCoeff() > 0.0) ||
      !slice.origin_mm.allFinite())
    slice.unusable = "whose pixel size or position is not a finite (and positive) number";
  else if (off(slice.along_row.norm() - 1.0) || off(slice.along_column.norm() - 1.0) ||
           off(slice.along_row.dot(slice.along_column)))
    slice.unusable = "whose rows and columns are not perpendicular";
}

void read_values_rule(DicomSlice& slice, const DicomSet& set, const Attributes& attributes) {
  const auto slope = attributes.numbers(values_macro, 0x0028, 0x1053),
             intercept = attributes.numbers(values_macro, 0x0028, 0x1052);
  slice.slope = slope.empty() ? 1.0 : slope[0];
  slice.intercept = intercept.empty() ? 0.0 : intercept[0];
  slice.value_type = slope.empty() && intercept.empty()
                         ? "unscaled"
                         : readable(attributes.text(values_macro, 0x0028, 0x1054), "");
  if (!std::isfinite(slice.slope) || !std::isfinite(slice.intercept) || slice.slope == 0.0)
    slice.unusable = "whose rescale slope or intercept cannot be used";
  const bool is_signed = whole_number(set, 0x0028, 0x0103).value_or(0) == 1;
  const auto stored = [&](uint16_t element) {
    auto value = whole_number(set, 0x0028, element);
    if (value && is_signed && *value > 32767) *value -= 65536;
    return value;
  };
  slice.padding = stored(0x0120);
  slice.padding_limit = stored(0x0121);
}

/// Refuses what the file cannot hold before anybody takes memory for it.
void check_claim(const fs::path& path, const DicomFile& file, double claimed_bytes) {
  double held = 0.0;
  for (const auto& piece : file.pixels) held += static_cast<double>(piece.bytes);
  const double most = file.packed ? room_bytes + max_packing * held : held;
  if (claimed_bytes > most)
    throw Error(ErrorKind::invalid_input,
                path.string() + " claims more pixels than it holds; it is cut short or damaged");
}

DicomSlice described(const fs::path& file, const DicomSet& set, int frame, bool grouped) {
  DicomSlice slice;
  slice.file = file;
  slice.frame = frame;
  const std::string characters = text_of(set, 0x0008, 0x0005);
  slice.modality = readable(text_of(set, 0x0008, 0x0060), "");
  slice.series_uid = readable(text_of(set, 0x0020, 0x000e), "");
  slice.description = readable(text_of(set, 0x0008, 0x103e), characters);
  slice.patient = {readable(text_of(set, 0x0010, 0x0010), characters),
                   readable(text_of(set, 0x0010, 0x0020), characters)};
  slice.localizer = text_of(set, 0x0008, 0x0008).find("LOCALIZER") != std::string::npos;
  slice.burnt_in = text_of(set, 0x0028, 0x0301) == "YES";
  const auto number = decimals(set, 0x0020, 0x0013);
  slice.number = grouped                                          ? frame
                 : number.empty() || !(std::abs(number[0]) < 1e9) ? 0
                                                                  : std::lround(number[0]);
  slice.rows = whole_number(set, 0x0028, 0x0010).value_or(0);
  slice.columns = whole_number(set, 0x0028, 0x0011).value_or(0);
  const Attributes attributes(set, frame);
  read_place(slice, attributes);
  read_values_rule(slice, set, attributes);
  const int bits = slice.bits_allocated = whole_number(set, 0x0028, 0x0100).value_or(0);
  slice.bits_stored = whole_number(set, 0x0028, 0x0101).value_or(bits);
  slice.is_signed = whole_number(set, 0x0028, 0x0103).value_or(0) == 1;
  const std::string colours = text_of(set, 0x0028, 0x0004);
  if (whole_number(set, 0x0028, 0x0002).value_or(1) != 1 || !(colours.empty() || colours.starts_with("MONO")))
    slice.unusable = "in colour (" + standard_term(colours) + ")";
  else if ((bits != 8 && bits != 16 && bits != 32) || slice.bits_stored < 1 || slice.bits_stored > bits)
    slice.unusable = "of " + std::to_string(bits) + " bits a pixel";
  else if (slice.rows < 1 || slice.columns < 1 || slice.rows > max_side || slice.columns > max_side)
    slice.unusable = "of " + std::to_string(slice.columns) + " x " + std::to_string(slice.rows) + " pixels";
  return slice;
}

}  // namespace

std::vector<DicomSlice> describe_dicom(const fs::path& path, const DicomFile& file) {
  const DicomSet& set = file.set;
  const auto count = decimals(set, 0x0028, 0x0008);
  const double frames = count.empty() ? 1.0 : count[0];
  const bool many = frames > 1.0, grouped = set.sequences.contains(frames_own);
  std::vector<DicomSlice> slices{described(path, set, 0, grouped)};
  if (slices[0].modality != "CT") return slices;
  if (!(frames >= 1.0 && frames <= max_frames))
    throw Error(ErrorKind::invalid_input, path.string() + " claims an impossible number of frames");
  const double samples = whole_number(set, 0x0028, 0x0002).value_or(1);
  check_claim(path, file,
              slices[0].bits_allocated / 8.0 * frames * samples * slices[0].rows * slices[0].columns);
  if (many && !grouped)
    slices[0].unusable = "with many frames in one file that do not say where each lies; convert it to NRRD";
  if (many && grouped && slices[0].unusable.empty())
    for (int frame = 1; frame < static_cast<int>(frames); ++frame)
      slices.push_back(described(path, set, frame, true));
  for (DicomSlice& slice : slices) slice.frames = static_cast<int>(frames);
  return slices;
}

}  // namespace ream::reader
