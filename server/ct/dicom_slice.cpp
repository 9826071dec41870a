#include "ct/dicom_slice.hpp"

#include <gdcmReader.h>
#include <gdcmSequenceOfItems.h>
#include <gdcmTrace.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.hpp"

namespace ream::ct {
namespace fs = std::filesystem;
namespace {

constexpr int max_side = 8192;            // the largest clinical matrix is 2048
constexpr uint64_t room_bytes = 8 << 20;  // a small packed file may still be one plain picture
constexpr uint64_t max_packing = 1000;    // beyond any coder on a real picture
constexpr double perpendicular_tolerance = 1e-3;

std::string bytes_of(const gdcm::DataSet& set, uint16_t group, uint16_t element) {
  const gdcm::Tag tag(group, element);
  if (!set.FindDataElement(tag)) return "";
  const gdcm::ByteValue* value = set.GetDataElement(tag).GetByteValue();
  return value == nullptr ? "" : std::string(value->GetPointer(), value->GetLength());
}

std::string trimmed(std::string text) {
  const auto blank = [](char c) { return c == ' ' || c == '\0'; };
  while (!text.empty() && blank(text.back())) text.pop_back();
  text.erase(text.begin(), std::find_if_not(text.begin(), text.end(), blank));
  return text;
}

std::string text_of(const gdcm::DataSet& set, uint16_t group, uint16_t element) {
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
std::vector<double> decimals(const gdcm::DataSet& set, uint16_t group, uint16_t element) {
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

std::optional<int> whole_number(const gdcm::DataSet& set, uint16_t group, uint16_t element) {
  const std::string bytes = bytes_of(set, group, element);
  if (bytes.size() < 2) return {};
  return static_cast<unsigned char>(bytes[0]) | static_cast<unsigned char>(bytes[1]) << 8;
}

gdcm::SmartPointer<gdcm::SequenceOfItems> items_of(const gdcm::DataSet& set, uint16_t group,
                                                   uint16_t element) {
  const gdcm::Tag tag(group, element);
  if (!set.FindDataElement(tag)) return nullptr;
  return set.GetDataElement(tag).GetValueAsSQ();
}

/// Where a frame's own attributes lie in a file of many frames (DICOM PS3.3, C.7.6.16): in its functional
/// groups, or in those that all frames share. In a file of one slice: in the data set itself.
class Attributes {
 public:
  Attributes(const gdcm::DataSet& file, int frame, bool grouped) : file_(file) {
    if (!grouped) return;
    own_ = items_of(file, 0x5200, 0x9230);
    shared_ = items_of(file, 0x5200, 0x9229);
    frame_ = static_cast<size_t>(frame) + 1;
  }

  std::vector<double> numbers(const gdcm::Tag& macro, uint16_t group, uint16_t element) const {
    return find<std::vector<double>>(macro,
                                     [&](const gdcm::DataSet& set) { return decimals(set, group, element); });
  }
  std::string text(const gdcm::Tag& macro, uint16_t group, uint16_t element) const {
    return find<std::string>(macro, [&](const gdcm::DataSet& set) { return text_of(set, group, element); });
  }

 private:
  template <typename Result, typename Read>
  Result find(const gdcm::Tag& macro, Read&& read) const {
    for (const auto& [groups, number] : {std::pair{own_, frame_}, std::pair{shared_, size_t{1}}}) {
      if (groups == nullptr || groups->GetNumberOfItems() < number) continue;
      const auto inner =
          items_of(groups->GetItem(number).GetNestedDataSet(), macro.GetGroup(), macro.GetElement());
      if (inner == nullptr || inner->GetNumberOfItems() < 1) continue;
      Result found = read(inner->GetItem(1).GetNestedDataSet());
      if (!found.empty()) return found;
    }
    return read(file_);
  }

  const gdcm::DataSet& file_;
  gdcm::SmartPointer<gdcm::SequenceOfItems> own_, shared_;
  size_t frame_ = 1;
};

const gdcm::Tag position_macro(0x0020, 0x9113), orientation_macro(0x0020, 0x9116),
    measures_macro(0x0028, 0x9110), values_macro(0x0028, 0x9145);

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

void read_values_rule(DicomSlice& slice, const gdcm::DataSet& set, const Attributes& attributes) {
  const auto slope = attributes.numbers(values_macro, 0x0028, 0x1053),
             intercept = attributes.numbers(values_macro, 0x0028, 0x1052);
  slice.slope = slope.empty() ? 1.0 : slope[0];
  slice.intercept = intercept.empty() ? 0.0 : intercept[0];
  slice.value_type =
      slope.empty() && intercept.empty() ? "unscaled" : attributes.text(values_macro, 0x0028, 0x1054);
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
void check_claim(const fs::path& file, const gdcm::Reader& reader, int bits, double frames, double pixels) {
  const double claimed = pixels * frames * bits / 8.0;
  const bool packed = reader.GetFile().GetHeader().GetDataSetTransferSyntax().IsEncapsulated() ||
                      reader.GetFile().GetHeader().GetDataSetTransferSyntax() ==
                          gdcm::TransferSyntax::DeflatedExplicitVRLittleEndian;
  const auto size = static_cast<double>(fs::file_size(file));
  const double most =
      packed ? static_cast<double>(room_bytes) + static_cast<double>(max_packing) * size : size;
  if (claimed > most)
    throw Error(ErrorKind::invalid_input,
                file.string() + " claims more pixels than it holds; it is cut short or damaged");
}

DicomSlice described(const fs::path& file, const gdcm::DataSet& set, int frame, bool grouped) {
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
  const auto number = decimals(set, 0x0020, 0x0013);
  slice.number = grouped                                          ? frame
                 : number.empty() || !(std::abs(number[0]) < 1e9) ? 0
                                                                  : std::lround(number[0]);
  slice.rows = whole_number(set, 0x0028, 0x0010).value_or(0);
  slice.columns = whole_number(set, 0x0028, 0x0011).value_or(0);
  const Attributes attributes(set, frame, grouped);
  read_place(slice, attributes);
  read_values_rule(slice, set, attributes);
  const int bits = whole_number(set, 0x0028, 0x0100).value_or(0);
  const std::string colours = text_of(set, 0x0028, 0x0004);
  if (whole_number(set, 0x0028, 0x0002).value_or(1) != 1 || !(colours.empty() || colours.starts_with("MONO")))
    slice.unusable = "in colour (" + readable(colours, "") + ")";
  else if (bits != 8 && bits != 16 && bits != 32)
    slice.unusable = "of " + std::to_string(bits) + " bits a pixel";
  else if (slice.rows < 1 || slice.columns < 1 || slice.rows > max_side || slice.columns > max_side)
    slice.unusable = "of " + std::to_string(slice.columns) + " x " + std::to_string(slice.rows) + " pixels";
  return slice;
}

}  // namespace

std::vector<DicomSlice> describe_dicom(const fs::path& file) {
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  gdcm::Reader reader;
  reader.SetFileName(file.c_str());
  if (!reader.ReadUpToTag(gdcm::Tag(0x7fe0, 0x0010)))
    throw Error(ErrorKind::invalid_input, file.string() + " cannot be read; its DICOM header is damaged");
  const gdcm::DataSet& set = reader.GetFile().GetDataSet();
  const auto count = decimals(set, 0x0028, 0x0008);
  const double frames = count.empty() ? 1.0 : count[0];
  if (!(frames >= 1.0 && frames <= 1e5))
    throw Error(ErrorKind::invalid_input, file.string() + " claims an impossible number of frames");
  const bool many = frames > 1.0, grouped = items_of(set, 0x5200, 0x9230) != nullptr;
  std::vector<DicomSlice> slices{described(file, set, 0, grouped)};
  if (slices[0].modality != "CT") return slices;
  const double bits = whole_number(set, 0x0028, 0x0100).value_or(16);
  const double samples = whole_number(set, 0x0028, 0x0002).value_or(1);
  check_claim(file, reader, static_cast<int>(bits), frames,
              samples * slices[0].rows * static_cast<double>(slices[0].columns));
  if (many && !grouped)
    slices[0].unusable = "with many frames in one file that do not say where each lies; convert it to NRRD";
  if (many && grouped && slices[0].unusable.empty())
    for (int frame = 1; frame < static_cast<int>(frames); ++frame)
      slices.push_back(described(file, set, frame, true));
  return slices;
}

}  // namespace ream::ct
