#include "voxelizer/voxel_files.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "core/error.hpp"

namespace ream::voxelizer {
namespace {

constexpr size_t max_header_bytes = 65536;

std::string exact(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

std::string header_of(const RasterGrid& grid, GridFormat format) {
  const int voxels_a_byte = format == GridFormat::bits ? 8 : 1;
  const Vec3 step(voxels_a_byte * grid.size_mm.x(), grid.size_mm.y(), grid.size_mm.z());
  const Vec3 first = grid.origin_mm + 0.5 * step;
  const Vec3i& d = grid.dims;
  std::ostringstream text;
  text << "NRRD0004\n# voxels of a triangle mesh, mm\ntype: uint8\ndimension: 3\nspace: "
          "left-posterior-superior\n"
       << "sizes: " << (d.x() + voxels_a_byte - 1) / voxels_a_byte << ' ' << d.y() << ' ' << d.z()
       << "\nspace directions: (" << exact(step.x()) << ",0,0) (0," << exact(step.y()) << ",0) (0,0,"
       << exact(step.z()) << ")\nkinds: domain domain domain\nencoding: raw\nspace origin: ("
       << exact(first.x()) << ',' << exact(first.y()) << ',' << exact(first.z()) << ")\n";
  if (format == GridFormat::bits) text << "ream_dims:=" << d.x() << ' ' << d.y() << ' ' << d.z() << '\n';
  text << '\n';
  return text.str();
}

/// Numbers in a text, whatever stands between them; a word that is none makes it short.
std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  const char* end = text.data() + text.size();
  for (const char* p = text.data(); p < end;) {
    if (std::string_view(" \t\r(),").find(*p) != std::string_view::npos) {
      ++p;
      continue;
    }
    double value = 0.0;
    const auto [next, failed] = std::from_chars(p, end, value);
    if (failed != std::errc{}) return numbers;
    numbers.push_back(value);
    p = next;
  }
  return numbers;
}

/// A header's fields and keys by name.
class Header {
 public:
  explicit Header(const std::filesystem::path& path) : path_(path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw Error(ErrorKind::not_found, "no such file: " + path.string());
    std::string line;
    if (!std::getline(in, line) || !line.starts_with("NRRD000")) refuse("it does not begin as a NRRD file");
    for (size_t read = 0; read < max_header_bytes && std::getline(in, line); read += line.size() + 1) {
      while (!line.empty() && line.back() == '\r') line.pop_back();
      if (line.empty()) return;
      const size_t colon = line.find(':');
      if (line.front() == '#' || colon == std::string::npos) continue;
      // `field: value` or `key:=value`.
      fields_[line.substr(0, colon)] = line.substr(std::min(line.size(), colon + 2));
    }
    if (!in.eof()) refuse("its header does not end");
  }

  bool has(const std::string& name) const { return fields_.contains(name); }
  std::string text(const std::string& name) const {
    const auto found = fields_.find(name);
    return found == fields_.end() ? std::string() : found->second;
  }
  std::vector<double> numbers(const std::string& name, size_t count) const {
    std::vector<double> values = numbers_in(text(name));
    if (values.size() != count) refuse("its header has no usable '" + name + "'");
    return values;
  }
  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(ErrorKind::invalid_input, path_.string() + " cannot be used as a grid: " + why);
  }

 private:
  const std::filesystem::path path_;
  std::map<std::string, std::string> fields_;
};

Vec3 voxel_size(const Header& header) {
  if (!header.has("space directions")) {
    const std::vector<double> s = header.numbers("spacings", 3);
    return {s[0], s[1], s[2]};
  }
  const std::vector<double> d = header.numbers("space directions", 9);
  for (size_t i = 0; i < 9; ++i) {
    const bool along = i % 4 == 0;
    if (along ? !(d[i] > 0.0) : std::abs(d[i]) > 1e-9 * d[i / 3 * 4])
      header.refuse("its axes do not run along x, y and z; resample it");
  }
  return {d[0], d[4], d[8]};
}

/// Centre of the first sample.
Vec3 first_centre(const Header& header) {
  if (!header.has("space origin")) return Vec3::Zero();
  const std::vector<double> o = header.numbers("space origin", 3);
  return {o[0], o[1], o[2]};
}

}  // namespace

void write_nrrd(const VoxelSet& set, GridFormat format, AtomicFile& file, const Progress& progress) {
  const RasterGrid& grid = set.grid();
  file.write(header_of(grid, format));
  std::vector<uint32_t> row(grid.words_per_row());
  const auto dims_x = static_cast<size_t>(grid.dims.x());
  std::vector<std::byte> bytes(dims_x);
  for (int w = 0; w < grid.dims.z(); ++w) {
    progress(w / static_cast<double>(grid.dims.z()), "writing the grid");
    for (int v = 0; v < grid.dims.y(); ++v) {
      set.read_row(v, w, row);
      if (format == GridFormat::bits) {
        file.write(std::as_bytes(std::span(row)).first((dims_x + 7) / 8));
        continue;
      }
      for (size_t u = 0; u < dims_x; ++u) bytes[u] = std::byte((row[u / 32] >> (u % 32)) & 1u);
      file.write(bytes);
    }
  }
}

RasterGrid grid_of_nrrd(const std::filesystem::path& path) {
  const Header header(path);
  const std::string space = header.text("space");
  if (!space.empty() && space != "left-posterior-superior" && space != "LPS")
    header.refuse("its space is " + space + "; only left-posterior-superior is understood");
  const bool bits = header.has("ream_dims");
  const std::vector<double> dims = bits ? numbers_in(header.text("ream_dims")) : header.numbers("sizes", 3);
  if (header.text("dimension") != "3" || dims.size() != 3) header.refuse("it does not have three axes");
  RasterGrid grid;
  Vec3 step = voxel_size(header);
  grid.origin_mm = first_centre(header) - 0.5 * step;
  if (bits) step.x() /= 8.0;
  grid.size_mm = step;
  for (size_t k = 0; k < 3; ++k) {
    if (!(dims[k] >= 1.0 && dims[k] <= max_voxels_a_side) || dims[k] != std::floor(dims[k]))
      header.refuse("its size along an axis is not a whole number from 1 to 2^20");
    grid.dims[static_cast<Eigen::Index>(k)] = static_cast<int>(dims[k]);
  }
  check_grid(grid);
  return grid;
}

}  // namespace ream::voxelizer
