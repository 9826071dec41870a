#include "ct/volume_claims.hpp"

#include <zlib.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "ct/volume_io.hpp"

namespace ream::ct {
namespace fs = std::filesystem;
namespace {

constexpr size_t max_header_bytes = 1 << 18;
constexpr double max_packing = 1100.0;  // zlib's limit is 1032
constexpr double perpendicular_tolerance = 1e-3, same_size_tolerance = 0.01;

struct Claims {
  std::vector<double> dims, sizes_mm;
  double bits = 0.0;  // a voxel, at least; 0: nothing to hold against the file
  bool packed = false;
  double before = 0.0;  // bytes before the voxels
  fs::path holder;      // of the voxels
};

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw Error(ErrorKind::invalid_input, path.string() + ": " + why);
}

std::string number_text(double v) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), v);
  return {text.data(), end.ptr};
}

void check(const Claims& claims, const fs::path& path) {
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
  const double holds =
      static_cast<double>(fs::file_size(claims.holder)) * (claims.packed ? max_packing : 1.0);
  if (claims.before + voxels * claims.bits / 8.0 > holds)
    refuse(path, "its header claims more voxels than the file holds; it is cut short or damaged");
}

/// Voxels in a file of their own must lie beside the header, so that nobody reads other people's files.
fs::path beside(const fs::path& path, const std::string& name) {
  if (name.empty() || name.find_first_of("/\\%") != std::string::npos || name.starts_with("LIST"))
    refuse(path, "its voxels must be in one file beside it, not in '" + name.substr(0, 100) + "'");
  const fs::path holder = path.parent_path() / name;
  if (!fs::is_regular_file(holder))
    throw Error(ErrorKind::not_found, "no such file: " + holder.string() + ", named by " + path.string());
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

using Header = std::map<std::string, std::string>;

/// The lines `key: value` or `key = value` of a text header up to its end.
Header header_of(const fs::path& path, char separator, const std::string& last_key) {
  std::ifstream in(path, std::ios::binary);
  std::string text(max_header_bytes, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<size_t>(in.gcount()));
  Header header;
  for (size_t start = 0; start < text.size();) {
    const size_t stop = std::min(text.find('\n', start), text.size());
    std::string line = text.substr(start, stop - start);
    start = stop + 1;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() && last_key.empty()) break;
    const size_t colon = line.find(separator);
    if (colon == std::string::npos) continue;
    std::string key = line.substr(0, colon), value = line.substr(colon + 1);
    std::erase_if(key, [](char c) { return c == ' ' || c == '\t'; });
    value.erase(0, std::min(value.find_first_not_of(" \t="), value.size()));
    while (!value.empty() && (value.back() == ' ' || value.back() == '\t')) value.pop_back();
    header[key] = value;
    if (key == last_key) break;
  }
  return header;
}

std::string value_of(const Header& header, std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (const auto found = header.find(key); found != header.end()) return found->second;
  return "";
}

double nrrd_bits(const std::string& type) {
  for (const char* small : {"char", "int8", "uint8"})
    if (type.find(small) != std::string::npos) return 8.0;
  if (type.find("short") != std::string::npos || type.find("int16") != std::string::npos) return 16.0;
  for (const char* large : {"long", "int64", "double"})
    if (type.find(large) != std::string::npos) return 64.0;
  return 32.0;
}

const char* const unknown_axes =
    "the file does not say how its axes lie in the patient; they were taken as left, posterior, superior, so "
    "check the side";

/// The library turns RAS into LPS; others it gets wrong or leaves as they are.
void check_nrrd_space(const Header& header, const fs::path& path, std::vector<std::string>& remarks) {
  std::string space = value_of(header, {"space"});
  for (char& c : space)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (space == "left-posterior-superior" || space == "lps" || space == "right-anterior-superior" ||
      space == "ras")
    return;
  if (space.starts_with("left-") || space.starts_with("right-") || space == "las")
    refuse(path, "its space " + space + " cannot be read; save it as left-posterior-superior");
  remarks.emplace_back(unknown_axes);
}

Claims nrrd_claims(const fs::path& path, std::vector<std::string>& remarks) {
  const Header header = header_of(path, ':', "");
  check_nrrd_space(header, path, remarks);
  Claims claims;
  claims.dims = numbers_in(value_of(header, {"sizes"}));
  const std::string directions = value_of(header, {"spacedirections"});
  if (directions.find("none") == std::string::npos) {
    const auto d = numbers_in(directions);
    for (size_t i = 0; i + 3 <= d.size(); i += 3)
      claims.sizes_mm.push_back(Vec3(d[i], d[i + 1], d[i + 2]).norm());
  }
  const auto spacings = numbers_in(value_of(header, {"spacings"}));
  claims.sizes_mm.insert(claims.sizes_mm.end(), spacings.begin(), spacings.end());
  const std::string encoding = value_of(header, {"encoding"}), data = value_of(header, {"datafile"});
  claims.packed = encoding != "raw";
  claims.bits = nrrd_bits(value_of(header, {"type"}));
  claims.holder = data.empty() ? path : beside(path, data);
  return claims;
}

double meta_bits(const std::string& type) {
  if (type.find("CHAR") != std::string::npos) return 8.0;
  if (type.find("SHORT") != std::string::npos) return 16.0;
  return type.find("DOUBLE") != std::string::npos || type.find("LONG") != std::string::npos ? 64.0 : 32.0;
}

Claims meta_claims(const fs::path& path) {
  const Header header = header_of(path, '=', "ElementDataFile");
  Claims claims;
  const auto dimensions = numbers_in(value_of(header, {"NDims"}));
  if (dimensions.size() != 1 || !(dimensions[0] >= 1.0 && dimensions[0] <= 4.0))
    refuse(path, "its header claims an impossible number of dimensions");
  claims.dims = numbers_in(value_of(header, {"DimSize"}));
  if (static_cast<double>(claims.dims.size()) != dimensions[0])
    refuse(path, "its header does not say one number of voxels for each of its dimensions");
  for (const char* key : {"ElementSpacing", "ElementSize"}) {
    const auto sizes = numbers_in(value_of(header, {key}));
    claims.sizes_mm.insert(claims.sizes_mm.end(), sizes.begin(), sizes.end());
  }
  claims.bits = meta_bits(value_of(header, {"ElementType"}));
  claims.packed = value_of(header, {"CompressedData"}).starts_with('T');
  const std::string data = value_of(header, {"ElementDataFile"});
  const bool inside = data == "LOCAL" || data == "Local" || data == "local";
  claims.holder = inside ? path : beside(path, data);
  return claims;
}

struct CloseGzip {
  void operator()(gzFile_s* file) const { gzclose(file); }
};

/// The fields of a NIfTI-1 header that decide (nifti1.h); numbers in the byte order of the file.
class NiftiHeader {
 public:
  explicit NiftiHeader(const fs::path& path) {
    const std::unique_ptr<gzFile_s, CloseGzip> file(gzopen(path.c_str(), "rb"));
    if (!file || gzread(file.get(), bytes_.data(), static_cast<unsigned>(bytes_.size())) < 348)
      refuse(path, "it is cut short or no NIfTI file");
    swapped_ = at<int32_t>(0) != 348;
    if (at<int32_t>(0) != 348) refuse(path, "it is no NIfTI-1 file");
  }
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
  std::array<char, 352> bytes_{};
  bool swapped_ = false;
};

/// The library silently orthonormalizes a sheared sform, or takes the qform instead.
void check_nifti_axes(const NiftiHeader& header, const fs::path& path) {
  if (header.at<int16_t>(254) <= 0 || header.at<int16_t>(40) < 3) return;
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
    if (!(std::abs(cosine) <= perpendicular_tolerance))
      refuse(path, "the voxel axes are not perpendicular; resample the volume first");
  }
}

/// Bits of a NIfTI data type of one number; 0 for others.
double nifti_bits(int type) {
  switch (type) {
    case 2:
    case 256:
      return 8.0;
    case 4:
    case 512:
      return 16.0;
    case 8:
    case 16:
    case 768:
      return 32.0;
    case 64:
    case 1024:
    case 1280:
      return 64.0;
    default:
      return 0.0;
  }
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
  claims.packed = path.extension() == ".gz";
  claims.holder = path;
  return claims;
}

}  // namespace

std::vector<std::string> check_claims(const fs::path& path) {
  const std::string name = path.filename().string();
  std::vector<std::string> remarks;
  if (name.ends_with(".nii") || name.ends_with(".nii.gz")) {
    const NiftiHeader header(path);
    check(nifti_claims(header, path), path);
    check_nifti_axes(header, path);
    if (header.at<int16_t>(252) <= 0 && header.at<int16_t>(254) <= 0) remarks.emplace_back(unknown_axes);
  } else if (name.ends_with(".mha") || name.ends_with(".mhd")) {
    check(meta_claims(path), path);
  } else {
    check(nrrd_claims(path, remarks), path);
  }
  return remarks;
}

}  // namespace ream::ct
