#include "reader/volume_header.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>
#include <zlib.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>

#include "core/error.hpp"
#include "core/text.hpp"
#include "reader/ct_files.hpp"
#include "reader/nifti2.hpp"

namespace ream::reader {
namespace fs = std::filesystem;
namespace {

constexpr size_t max_header_bytes = 4 << 20;
/// MetaIO reads lines into buffers of fixed lengths; no header needs more than this.
constexpr char escape = 0x1b;  ///< in names of other alphabets (ISO 2022), which DICOM may have left there
constexpr size_t max_meta_line_bytes = 450, max_meta_key_bytes = 64;
constexpr double max_deflation = 1100.0;  // zlib's limit is 1032
constexpr double nifti_axis_tolerance = 1e-3, same_size_tolerance = 0.01;

const char* const unknown_axes =
    "the file does not say how its axes lie in the patient; they were taken as left, posterior, superior, so "
    "check the side";

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw Error(ErrorKind::invalid_input, path.string() + ": " + why);
}

[[noreturn]] void cut_short(const fs::path& path) {
  throw Error(ErrorKind::invalid_input,
              path.string() + " is cut short or damaged; copy it again from its source");
}

std::string number_text(double v) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), v);
  return {text.data(), end.ptr};
}

struct Claims {
  std::vector<double> dims, sizes_mm;
  double bits = 0.0;  // a voxel, at least; 0: nothing to hold against the file
  bool packed = false;
  double before = 0.0;  // bytes before the voxels
};

void check(const Claims& claims, const fs::path& path, const fs::path& voxel_file) {
  double voxels = 1.0;
  if (claims.dims.empty()) refuse(path, "its header does not say how many voxels there are");
  for (const double n : claims.dims) {
    if (!(n >= 1.0) || n != std::floor(n))
      refuse(path, "its header claims " + number_text(n) + " voxels along an axis");
    voxels *= n;
  }
  if (!(voxels <= max_ct_voxels))
    refuse(path, "its header claims " + number_text(voxels) + " voxels; a CT here has at most 1e9");
  for (const double size : claims.sizes_mm)
    if (!std::isfinite(size) || !(size > 0.0))
      refuse(path, "its header claims a voxel size of " + number_text(size) + " mm; it must be positive");
  const double holds = static_cast<double>(fs::file_size(voxel_file)) * (claims.packed ? max_deflation : 1.0);
  if (claims.before + voxels * claims.bits / 8.0 > holds)
    refuse(path, "its header claims more voxels than the file holds; it is cut short or damaged");
}

/// Voxels in a file of their own must lie beside the header, so that nobody reads other people's files.
fs::path beside(const fs::path& path, const std::string& name) {
  if (name.empty() || name.find_first_of("/\\%") != std::string::npos || name.starts_with("LIST"))
    refuse(path, "its voxels must be in one file beside it, not in '" + name.substr(0, 100) + "'");
  const fs::path holder = path.parent_path() / name;
  std::error_code failed;
  if (fs::is_symlink(fs::symlink_status(holder, failed)))
    refuse(path, "its voxels must be in a file, not in the link " + name.substr(0, 100));
  if (!fs::is_regular_file(holder, failed))
    throw Error(ErrorKind::not_found, "no such file: " + (path.parent_path() / name.substr(0, 100)).string() +
                                          ", named by " + path.string());
  return holder;
}

std::vector<double> numbers_in(std::string text) {
  for (char& c : text)
    if (c == '(' || c == ')' || c == ',') c = ' ';
  std::vector<double> numbers;
  const char *at = text.data(), *end = at + text.size();
  while (at != end) {
    if (*at == ' ' || *at == '\t' || *at == '\r' || *at == '+') {
      ++at;
      continue;
    }
    double number = std::nan("");
    const auto parsed = std::from_chars(at, end, number);
    numbers.push_back(number);
    at = parsed.ec == std::errc() ? parsed.ptr : std::find(at, end, ' ');
  }
  return numbers;
}

double nrrd_bits(const std::string& type) {
  for (const char* small : {"char", "int8", "uint8"})
    if (type.find(small) != std::string::npos) return 8.0;
  if (type.find("short") != std::string::npos || type.find("int16") != std::string::npos) return 16.0;
  for (const char* large : {"long", "int64", "double"})
    if (type.find(large) != std::string::npos) return 64.0;
  return 32.0;
}

double meta_bits(const std::string& type) {
  if (type.find("CHAR") != std::string::npos) return 8.0;
  if (type.find("SHORT") != std::string::npos) return 16.0;
  return type.find("DOUBLE") != std::string::npos || type.find("LONG") != std::string::npos ? 64.0 : 32.0;
}

struct CloseGzip {
  void operator()(gzFile_s* file) const { gzclose(file); }
};

/// The fields of a NIfTI header that decide, as NIfTI-1 has them (nifti1.h); numbers in the byte order of the
/// file.
class NiftiHeader {
 public:
  explicit NiftiHeader(const fs::path& path) {
    const std::unique_ptr<gzFile_s, CloseGzip> file(gzopen(path.c_str(), "rb"));
    const int got = file ? gzread(file.get(), bytes_.data(), static_cast<unsigned>(bytes_.size())) : -1;
    if (got < static_cast<int>(nifti1_header_bytes)) refuse(path, "it is cut short or no NIfTI file");
    for (const bool swapped : {false, true}) {
      swapped_ = swapped;
      if (at<int32_t>(0) == static_cast<int32_t>(nifti1_header_bytes)) return;
      if (at<int32_t>(0) != static_cast<int32_t>(nifti2_header_bytes)) continue;
      if (got < static_cast<int>(nifti2_header_bytes)) refuse(path, "it is cut short");
      narrowed_ = nifti1_of(bytes_, swapped, path.string());
      bytes_ = narrowed_->bytes;
      return;
    }
    refuse(path, "it is no NIfTI file");
  }
  /// Of a NIfTI-2 file; all else here is as NIfTI-1 has it.
  const std::optional<Nifti1Header>& narrowed() const { return narrowed_; }

  template <typename T>
  T at(size_t offset) const {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), bytes_.data() + offset, sizeof(T));
    if (swapped_) std::reverse(raw.begin(), raw.end());
    T value;
    std::memcpy(&value, raw.data(), sizeof(T));
    return value;
  }

 private:
  std::string bytes_ = std::string(nifti2_header_bytes, '\0');
  bool swapped_ = false;
  std::optional<Nifti1Header> narrowed_;
};

/// The library ends the program where axes that it uses are no numbers, or a flat image's have no length.
void check_nifti_numbers(const NiftiHeader& header, const fs::path& path) {
  if (header.at<int16_t>(40) < 3)
    throw Error(ErrorKind::invalid_input, path.string() + " is a flat image; a CT has three dimensions");
  constexpr size_t qform = 256, sform = 280, after_sform = 328;
  const size_t begin = header.at<int16_t>(252) > 0 ? qform : sform;
  const size_t end = header.at<int16_t>(254) > 0 ? after_sform : sform;
  for (size_t at = begin; at < end; at += sizeof(float))
    if (!std::isfinite(header.at<float>(at)))
      refuse(path, "its header says how its axes lie in something that is no number");
}

/// The library silently orthonormalizes a sheared sform, or takes the qform instead.
void check_nifti_axes(const NiftiHeader& header, const fs::path& path) {
  check_nifti_numbers(header, path);
  if (header.at<int16_t>(254) <= 0) return;
  Mat3 columns;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      columns(row, column) = header.at<float>(static_cast<size_t>(280 + 16 * row + 4 * column));
  for (int k = 0; k < 3; ++k) {
    const double size = header.at<float>(static_cast<size_t>(80 + 4 * k)), length = columns.col(k).norm();
    if (!(std::abs(length - size) <= same_size_tolerance * size))
      refuse(path, "its header gives two voxel sizes, " + number_text(static_cast<float>(size)) + " and " +
                       number_text(static_cast<float>(length)) + " mm");
    const int next = (k + 1) % 3;
    const double cosine = columns.col(k).normalized().dot(columns.col(next).normalized());
    if (!(std::abs(cosine) <= nifti_axis_tolerance))
      refuse(path, "the voxel axes are not perpendicular; resample the volume first");
  }
}

/// Bits of a NIfTI data type of one number; 0 for others.
double nifti_bits(int type) {
  switch (type) {
    case 2:
    case 256: return 8.0;
    case 4:
    case 512: return 16.0;
    case 8:
    case 16:
    case 768: return 32.0;
    case 64:
    case 1024:
    case 1280: return 64.0;
    default: return 0.0;
  }
}

/// Size after unpacking what follows byte `start` (what is not packed counts as it is); throws when the
/// stream is damaged or has no end.
uint64_t unpacked_bytes(const fs::path& path, off_t start = 0) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw Error(ErrorKind::io, "cannot read " + path.string());
  ::lseek(descriptor, start, SEEK_SET);
  const gzFile file = gzdopen(descriptor, "rb");
  if (file == nullptr) {
    ::close(descriptor);
    throw Error(ErrorKind::io, "cannot read " + path.string());
  }
  std::vector<char> piece(1 << 18);
  uint64_t total = 0;
  int got = 0;
  while ((got = gzread(file, piece.data(), static_cast<unsigned>(piece.size()))) > 0)
    total += static_cast<uint64_t>(got);
  // A stream that ends too early is told only on closing.
  const int closed = gzclose(file);
  if (got < 0 || closed != Z_OK) cut_short(path);
  return total;
}

struct EndInflate {
  void operator()(z_stream* stream) const {
    inflateEnd(stream);
    delete stream;
  }
};

/// Checks that a zlib stream from byte `start` on is whole and makes so many bytes: the reading library hands
/// out zeros for a damaged one.
void check_deflated(const fs::path& path, uint64_t start, uint64_t needed) {
  std::ifstream in(path, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(start));
  const std::unique_ptr<z_stream, EndInflate> stream(new z_stream{});
  constexpr int any_header = 15 + 32;
  if (inflateInit2(stream.get(), any_header) != Z_OK)
    throw Error(ErrorKind::io, "no memory to unpack " + path.string());
  std::vector<unsigned char> packed(1 << 18), plain(1 << 18);
  uint64_t total = 0;
  for (int state = Z_OK; state != Z_STREAM_END;) {
    in.read(reinterpret_cast<char*>(packed.data()), static_cast<std::streamsize>(packed.size()));
    stream->next_in = packed.data();
    stream->avail_in = static_cast<unsigned>(in.gcount());
    if (stream->avail_in == 0) cut_short(path);
    while (stream->avail_in > 0 && state != Z_STREAM_END) {
      stream->next_out = plain.data();
      stream->avail_out = static_cast<unsigned>(plain.size());
      state = inflate(stream.get(), Z_NO_FLUSH);
      if (state != Z_OK && state != Z_STREAM_END) cut_short(path);
      total += plain.size() - stream->avail_out;
    }
  }
  if (total < needed) cut_short(path);
}

bool names_space(const std::string& line) {
  return line.starts_with("space:") || line.starts_with("space dimension:");
}

bool needs_space(const std::string& line) {
  return line.starts_with("space directions:") || line.starts_with("space origin:") ||
         line.starts_with("space units:") || line.starts_with("measurement frame:");
}

Claims nifti_claims(const NiftiHeader& header, const fs::path& path) {
  Claims claims;
  const int dimensions = header.at<int16_t>(40);
  if (dimensions < 1 || dimensions > 7) refuse(path, "its header claims an impossible number of dimensions");
  for (int k = 1; k <= dimensions; ++k)
    claims.dims.push_back(header.at<int16_t>(static_cast<size_t>(40 + 2 * k)));
  for (int k = 1; k <= std::min(dimensions, 3); ++k)
    claims.sizes_mm.push_back(header.at<float>(static_cast<size_t>(76 + 4 * k)));
  claims.bits = nifti_bits(header.at<int16_t>(70));
  if (claims.bits != header.at<int16_t>(72))
    refuse(path, "its header claims voxels of a kind that is no single number, or of two sizes at once");
  claims.before = header.at<float>(108);
  if (!(claims.before >= 348.0 && claims.before <= 1e6))
    refuse(path, "its header claims that the voxels begin at byte " + number_text(header.at<float>(108)));
  claims.packed = lower(path.extension().string()) == ".gz";
  return claims;
}

struct TextHeader {
  std::map<std::string, std::string> fields;
  std::vector<std::string> lines;
  uint64_t end = 0;
};

/// Libraries differ in what they take for the field that names another file, so that only one spelling of it
/// passes, whatever stands before and between its letters.
void refuse_second_names(const fs::path& path, const std::string& line, const std::string& key) {
  std::string letters;
  for (const char c : lower(line.substr(0, line.find_first_of(":=")))) {
    if (c >= 'a' && c <= 'z') letters += c;
  }
  if (letters.find("datafile") != std::string::npos && key != "ElementDataFile" && key != "datafile")
    refuse(path, "its header has a line '" + line.substr(0, 60) + "', which may name another file");
}

/// The libraries take a control character or the first of ':' and '=' for the end of a key, and go on reading
/// in the middle of a line that is longer than they expect. What they could take for two lines, or another
/// key than is meant, is refused, so that a header says the same to them and here. `separator`: '=' for
/// MetaImage, ':' for NRRD.
void check_line(const fs::path& path, const std::string& line, char separator, bool first) {
  const auto shown = [&] { return "a line '" + one_line(line.substr(0, 60), 60) + "'"; };
  if (std::any_of(line.begin(), line.end(),
                  [](char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != escape; }))
    refuse(path, "its header has " + shown() + " with control characters");
  const size_t end = line.find_first_of(":=");
  if (separator == '=') {
    const bool blank = line.find_first_not_of(" \t") == std::string::npos;
    if (line.size() > max_meta_line_bytes) refuse(path, "its header has " + shown() + ", which is too long");
    if (!blank && (end == std::string::npos || line[end] != '=' || end > max_meta_key_bytes))
      refuse(path, "its header has " + shown() + ", which is no 'key = value'");
  } else if (end == std::string::npos && !first && !line.starts_with('#')) {
    refuse_second_names(path, line, "");
  }
}

/// The lines `key: value` or `key = value` of a text header up to the empty one or the one of `last_key`.
/// Those of a NRRD file (':') are in any case.
TextHeader text_header(const fs::path& path, char separator, const std::string& last_key) {
  std::ifstream in(path, std::ios::binary);
  std::error_code unknown;  // then it is as large as can be
  std::string text(std::min<uintmax_t>(max_header_bytes, fs::file_size(path, unknown)), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<size_t>(in.gcount()));
  TextHeader header;
  for (size_t start = 0; start < text.size();) {
    const size_t stop = std::min(text.find('\n', start), text.size());
    std::string line = text.substr(start, stop - start);
    start = stop + 1;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() && last_key.empty()) {
      header.end = start;
      break;
    }
    check_line(path, line, separator, header.lines.empty());
    header.lines.push_back(line);
    const size_t colon = line.find(separator);
    if (colon == std::string::npos) continue;
    std::string key = line.substr(0, colon), value = line.substr(colon + 1);
    if (separator == ':')
      std::erase_if(key = lower(key), [](char c) { return c == ' ' || c == '\t'; });
    else
      key.erase(key.find_last_not_of(" \t") + 1);
    refuse_second_names(path, line, key);
    value.erase(0, std::min(value.find_first_not_of(" \t="), value.size()));
    while (!value.empty() && (value.back() == ' ' || value.back() == '\t')) value.pop_back();
    header.fields[key] = value;
    if (key != last_key) continue;
    header.end = start;
    break;
  }
  if (header.end == 0 && text.size() == max_header_bytes)
    refuse(path, "its header has no end within " + std::to_string(max_header_bytes >> 20) + " MB");
  return header;
}

/// As the library of MetaImage takes a word for true.
bool says_yes(const std::string& word) {
  return !word.empty() && std::string_view("Tt1").find(word[0]) != std::string_view::npos;
}

bool is_meta(const fs::path& path) {
  const std::string name = lower(path.filename().string());
  return name.ends_with(".mha") || name.ends_with(".mhd");
}

TextHeader text_header_of(const fs::path& path) {
  const bool meta = is_meta(path);
  return text_header(path, meta ? '=' : ':', meta ? "ElementDataFile" : "");
}

}  // namespace

std::string voxel_file_named_in(const fs::path& header) {
  const TextHeader read = text_header_of(header);
  const auto named = read.fields.find(is_meta(header) ? "ElementDataFile" : "datafile");
  return named == read.fields.end() || lower(named->second) == "local" ? "" : named->second;
}

VolumeHeader::VolumeHeader(const fs::path& path) : path_(path), readable_(path), voxels_(path) {
  const std::string name = lower(path.filename().string());
  if (name.ends_with(".nii") || name.ends_with(".nii.gz")) {
    format_ = Format::nifti;
    check_nifti();
    return;
  }
  if (is_meta(path)) format_ = Format::meta;
  TextHeader header = text_header_of(path);
  fields_ = std::move(header.fields);
  lines_ = std::move(header.lines);
  end_ = header.end;
  if (format_ == Format::meta)
    check_meta();
  else
    check_nrrd();
}

VolumeHeader::~VolumeHeader() {
  std::error_code ignored;
  if (readable_ != path_) fs::remove(readable_, ignored);
}

std::string VolumeHeader::field(const char* key) const {
  const auto found = fields_.find(key);
  return found == fields_.end() ? "" : found->second;
}

void VolumeHeader::check_nrrd() {
  // The library turns RAS into LPS; others it gets wrong or leaves as they are.
  const std::string space = lower(field("space"));
  if (space.ends_with("-time") || space == "last" || space == "rast" || space == "lpst")
    refuse(path_, "its space " + space + " has an axis of time; save one moment as left-posterior-superior");
  const bool known = space == "left-posterior-superior" || space == "lps" ||
                     space == "right-anterior-superior" || space == "ras";
  if (!known && (space.starts_with("left-") || space.starts_with("right-") || space == "las"))
    refuse(path_, "its space " + space + " cannot be read; save it as left-posterior-superior");
  if (!known) warnings_.emplace_back(unknown_axes);
  Claims claims;
  claims.dims = numbers_in(field("sizes"));
  const std::string directions = field("spacedirections");
  if (directions.find("none") == std::string::npos) {
    const auto d = numbers_in(directions);
    for (size_t i = 0; i + 3 <= d.size(); i += 3)
      claims.sizes_mm.push_back(Vec3(d[i], d[i + 1], d[i + 2]).norm());
  }
  const auto spacings = numbers_in(field("spacings"));
  claims.sizes_mm.insert(claims.sizes_mm.end(), spacings.begin(), spacings.end());
  claims.packed = field("encoding") != "raw";
  claims.bits = nrrd_bits(field("type"));
  if (!field("datafile").empty()) voxels_ = beside(path_, field("datafile"));
  check(claims, path_, voxels_);
}

void VolumeHeader::check_meta() {
  Claims claims;
  const auto dimensions = numbers_in(field("NDims"));
  if (dimensions.size() != 1 || !(dimensions[0] >= 1.0 && dimensions[0] <= 4.0))
    refuse(path_, "its header claims an impossible number of dimensions");
  claims.dims = numbers_in(field("DimSize"));
  if (static_cast<double>(claims.dims.size()) != dimensions[0])
    refuse(path_, "its header does not say one number of voxels for each of its dimensions");
  for (const char* key : {"ElementSpacing", "ElementSize"}) {
    const auto sizes = numbers_in(field(key));
    claims.sizes_mm.insert(claims.sizes_mm.end(), sizes.begin(), sizes.end());
  }
  claims.bits = meta_bits(field("ElementType"));
  claims.packed = says_yes(field("CompressedData"));
  const std::string data = field("ElementDataFile");
  if (data != "LOCAL" && data != "Local" && data != "local") voxels_ = beside(path_, data);
  check(claims, path_, voxels_);
}

void VolumeHeader::check_nifti() {
  const NiftiHeader header(path_);
  const Claims claims = nifti_claims(header, path_);
  check(claims, path_, path_);
  check_nifti_axes(header, path_);
  if (header.narrowed()) {
    double bytes = claims.bits / 8.0;
    for (const double n : claims.dims) bytes *= n;
    readable_ = write_as_nifti1(path_, *header.narrowed(), static_cast<uint64_t>(bytes));
  }
  if (header.at<int16_t>(252) <= 0 && header.at<int16_t>(254) <= 0) warnings_.emplace_back(unknown_axes);
}

void VolumeHeader::check_complete(uint64_t image_bytes) const {
  if (format_ == Format::nifti) {
    if (unpacked_bytes(readable_) < nifti1_voxels_begin + image_bytes) cut_short(path_);
  } else if (format_ == Format::meta) {
    const uint64_t before = voxels_ == path_ ? end_ : 0;
    if (says_yes(field("CompressedData")))
      check_deflated(voxels_, before, image_bytes);
    else if (fs::file_size(voxels_) < before + image_bytes)
      cut_short(voxels_);
  } else if (lower(path_.extension().string()) == ".nrrd" && end_ > 0) {
    for (const char* elsewhere : {"datafile", "lineskip", "byteskip"})
      if (fields_.contains(elsewhere)) return;
    const bool packed = field("encoding").find("gz") != std::string::npos;
    if (packed && unpacked_bytes(path_, static_cast<off_t>(end_)) < image_bytes) cut_short(path_);
  }
}

uint64_t VolumeHeader::raw_begin(uint64_t image_bytes) const {
  const std::string ending = lower(path_.extension().string());
  bool raw = voxels_ == path_ && end_ + image_bytes == fs::file_size(path_);
  if (ending == ".nrrd")
    raw = raw && field("encoding") == "raw" && !fields_.contains("lineskip") &&
          !fields_.contains("byteskip") && (field("endian").empty() || field("endian") == "little");
  else if (ending == ".mha")
    raw = raw && !fields_.contains("HeaderSize") && says_yes(field("BinaryData")) &&
          !says_yes(field("CompressedData")) && !says_yes(field("ElementByteOrderMSB")) &&
          !says_yes(field("BinaryDataByteOrderMSB"));
  else
    raw = false;
  return raw ? end_ : 0;
}

const fs::path& VolumeHeader::readable_path() {
  if (format_ != Format::nrrd || readable_ != path_) return readable_;
  auto lines = lines_;
  if (lines.empty() || !lines.front().starts_with("NRRD")) return readable_;
  const auto space = std::find_if(lines.begin(), lines.end(), names_space);
  const auto first_need = std::find_if(lines.begin(), lines.end(), needs_space);
  if (space == lines.end() || first_need >= space) return readable_;
  const size_t before_voxels = lines.size() + 1;
  bool elsewhere = false;
  for (std::string& line : lines)
    for (const std::string key : {"data file:", "datafile:"})
      if (line.starts_with(key)) {
        const size_t name = line.find_first_not_of(' ', key.size());
        line = "data file: " +
               (fs::absolute(path_).parent_path() / line.substr(std::min(name, line.size()))).string();
        elsewhere = true;
      }
  std::stable_partition(lines.begin() + 1, lines.end(), [](const std::string& line) {
    return line.starts_with("dimension:") || names_space(line);
  });
  // A data file ends the header, so it comes last.
  std::stable_partition(lines.begin(), lines.end(),
                        [](const std::string& line) { return !line.starts_with("data file:"); });
  if (!elsewhere) {
    lines.push_back("line skip: " + std::to_string(before_voxels));
    lines.push_back("data file: " + fs::absolute(path_).string());
  }
  std::string name = (fs::current_path() / "ream-XXXXXX.nhdr").string();
  constexpr int ending_bytes = 5;
  const int file = ::mkstemps(name.data(), ending_bytes);
  if (file < 0) throw Error(ErrorKind::io, "cannot write " + name);
  ::close(file);
  readable_ = name;
  std::ofstream out(readable_, std::ios::binary);
  for (const std::string& line : lines) out << line << '\n';
  if (!out.flush()) throw Error(ErrorKind::io, "cannot write " + name);
  return readable_;
}

}  // namespace ream::reader
