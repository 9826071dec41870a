#include <fcntl.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "core/error.hpp"
#include "core/file_descriptor.hpp"
#include "fe/mesh_file_checks.hpp"

namespace ream::fe {
namespace {

constexpr size_t max_head_bytes = 1 << 16;
constexpr uint64_t elements_of_read = 1 << 16;

/// A file that is read from any place.
class ReadFile {
 public:
  explicit ReadFile(const std::filesystem::path& path)
      : name_(path.string()), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (!file_) throw Error(ErrorKind::io, "cannot read " + name_ + ": " + std::strerror(errno));
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(ErrorKind::invalid_input, name_ + ": " + why);
  }
  size_t read_some(uint64_t at, void* to, size_t bytes) const {
    const ssize_t got = file_.read_at(at, {static_cast<std::byte*>(to), bytes});
    if (got < 0) throw Error(ErrorKind::io, "cannot read " + name_ + ": " + std::strerror(errno));
    return static_cast<size_t>(got);
  }
  template <typename T>
  void read(uint64_t at, std::vector<T>& values, size_t count) const {
    values.resize(count);
    if (read_some(at, values.data(), count * sizeof(T)) != count * sizeof(T)) refuse("is cut short");
  }

 private:
  std::string name_;
  FileDescriptor file_;
};

/// One array of the appended data.
struct FileArray {
  std::string type;
  uint64_t begin = 0, bytes = 0;
};

class VtuCheck {
 public:
  VtuCheck(const std::filesystem::path& path, const MemoryBudget& budget, const ElementVisitor& visit)
      : file_(path), budget_(budget), sum_(visit) {}

  MeshFacts check(const Progress& progress) {
    read_head();
    if (elements_ == 0) file_.refuse("holds no cells");
    const std::string type = array("connectivity").type;
    if (type == "Int32")
      check_cells<int32_t>(progress);
    else if (type == "Int64")
      check_cells<int64_t>(progress);
    else
      file_.refuse("its connectivity is of type " + type);
    check_values();
    return {nodes_, elements_, materials_.size(), sum_.volume_mm3(), sum_.min_jacobian_mm3()};
  }

 private:
  std::string attribute(const std::string& tag, const std::string& name) const {
    const size_t at = tag.find(" " + name + "=\"");
    if (at == std::string::npos) file_.refuse("its head says no " + name);
    const size_t begin = at + name.size() + 3;
    return tag.substr(begin, tag.find('"', begin) - begin);
  }
  uint64_t number(const std::string& tag, const std::string& name) const {
    return std::strtoull(attribute(tag, name).c_str(), nullptr, 10);
  }

  void read_head() {
    head_.resize(max_head_bytes);
    head_.resize(file_.read_some(0, head_.data(), head_.size()));
    const size_t mark = head_.find("<AppendedData encoding=\"raw\">");
    data_ = head_.find('_', mark == std::string::npos ? head_.size() : mark);
    if (data_ == std::string::npos) file_.refuse("has no appended raw data");
    head_.resize(data_++);
    const std::string piece = tag_with("<Piece", 0);
    nodes_ = number(piece, "NumberOfPoints");
    elements_ = number(piece, "NumberOfCells");
  }

  std::string tag_with(const std::string& text, size_t from) const {
    const size_t at = head_.find(text, from);
    if (at == std::string::npos) file_.refuse("its head has no " + text);
    const size_t begin = head_.rfind('<', at);
    return head_.substr(begin, head_.find('>', at) - begin);
  }

  FileArray array(const std::string& name) const {
    const std::string tag = tag_with("Name=\"" + name + "\"", 0);
    FileArray result{attribute(tag, "type"), data_ + number(tag, "offset"), 0};
    std::vector<uint64_t> bytes;
    file_.read(result.begin, bytes, 1);
    result.begin += sizeof(uint64_t);
    result.bytes = bytes[0];
    return result;
  }
  FileArray array(const std::string& name, const std::string& type, uint64_t bytes) const {
    const FileArray result = array(name);
    if (result.type != type || result.bytes != bytes)
      file_.refuse("its array " + name + " is not of " + type + " for each node or cell");
    return result;
  }

  template <typename Index>
  void check_cells(const Progress& progress) {
    const std::string type = sizeof(Index) == 4 ? "Int32" : "Int64";
    const FileArray corners = array("connectivity", type, 8 * elements_ * sizeof(Index)),
                    ends = array("offsets", type, elements_ * sizeof(Index)),
                    kinds = array("types", "UInt8", elements_);
    IdSet used;
    std::vector<Index> ids, end_of;
    std::vector<uint8_t> kind;
    for (uint64_t first = 0; first < elements_; first += elements_of_read) {
      progress(static_cast<double>(first) / static_cast<double>(elements_), "checking");
      const uint64_t count = std::min(elements_of_read, elements_ - first);
      file_.read(corners.begin + 8 * first * sizeof(Index), ids, 8 * count);
      file_.read(ends.begin + first * sizeof(Index), end_of, count);
      file_.read(kinds.begin + first, kind, count);
      for (uint64_t i = 0; i < count; ++i) {
        const std::string cell = "cell " + std::to_string(first + i);
        if (kind[i] != 12) file_.refuse(cell + " is no hexahedron");
        if (static_cast<uint64_t>(end_of[i]) != 8 * (first + i + 1))
          file_.refuse(cell + " has a wrong offset");
        check_ids(std::span<const Index>(ids).subspan(8 * i, 8), cell, used);
      }
      add_shapes<Index>(ids, first);
    }
    if (used.size() != nodes_)
      file_.refuse(std::to_string(nodes_ - used.size()) + " points belong to no cell");
  }

  template <typename Index>
  void check_ids(std::span<const Index> ids, const std::string& cell, IdSet& used) const {
    for (size_t k = 0; k < ids.size(); ++k) {
      if (ids[k] < 0 || static_cast<uint64_t>(ids[k]) >= nodes_)
        file_.refuse(cell + " names point " + std::to_string(ids[k]));
      if (std::find(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(k), ids[k]) !=
          ids.begin() + static_cast<std::ptrdiff_t>(k))
        file_.refuse(cell + " names point " + std::to_string(ids[k]) + " twice");
      used.insert(static_cast<uint64_t>(ids[k]));
    }
  }

  template <typename Index>
  void add_shapes(const std::vector<Index>& ids, uint64_t first) {
    const auto [least, greatest] = std::minmax_element(ids.begin(), ids.end());
    const auto low = static_cast<uint64_t>(*least), high = static_cast<uint64_t>(*greatest);
    if (high - low >= max_nodes_at_hand(budget_))
      file_.refuse("cells name points too far apart to be checked within --memory-mb");
    const FileArray points = array("Points", "Float64", nodes_ * sizeof(Vec3));
    std::vector<double> at;
    file_.read(points.begin + low * sizeof(Vec3), at, 3 * (high - low + 1));
    for (size_t i = 0; i < ids.size(); i += 8) {
      HexCorners corners;
      for (size_t k = 0; k < 8; ++k) {
        corners[k] = Eigen::Map<const Vec3>(at.data() + 3 * (static_cast<uint64_t>(ids[i + k]) - low));
        if (!corners[k].allFinite()) file_.refuse("a point has a coordinate that is no number");
      }
      if (!sum_.add(corners))
        file_.refuse("cell " + std::to_string(first + i / 8) + " has a Jacobian that is not positive");
    }
  }

  void check_values() {
    const FileArray grays = array("gray", "Float32", elements_ * 4),
                    moduli = array("modulus_MPa", "Float32", elements_ * 4),
                    numbers = array("material", "Int32", elements_ * 4);
    std::vector<float> gray, modulus;
    std::vector<int32_t> material;
    for (uint64_t first = 0; first < elements_; first += elements_of_read) {
      const uint64_t count = std::min(elements_of_read, elements_ - first);
      file_.read(grays.begin + first * 4, gray, count);
      file_.read(moduli.begin + first * 4, modulus, count);
      file_.read(numbers.begin + first * 4, material, count);
      for (uint64_t i = 0; i < count; ++i) {
        if (!std::isfinite(gray[i]) || !(modulus[i] > 0.0f) || !std::isfinite(modulus[i]) || material[i] < 1)
          file_.refuse("cell " + std::to_string(first + i) + " has no gray value, modulus and material");
        materials_.insert(material[i]);
      }
    }
  }

  ReadFile file_;
  const MemoryBudget& budget_;
  HexSum sum_;
  std::string head_;
  size_t data_ = 0;
  uint64_t nodes_ = 0, elements_ = 0;
  std::set<int32_t> materials_;
};

}  // namespace

MeshFacts check_vtu(const std::filesystem::path& path, const MemoryBudget& budget, const Progress& progress,
                    const ElementVisitor& visit) {
  return VtuCheck(path, budget, visit).check(progress);
}

}  // namespace ream::fe
