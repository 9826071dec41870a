#include "reader/mesh_file.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace ream::reader {
namespace {

enum class PlyType { i8, u8, i16, u16, i32, u32, f32, f64 };
enum class PlyEncoding { text, little_endian, big_endian };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::f32;
  bool is_list = false;
  PlyType count_type = PlyType::u8;
};

struct PlyElement {
  std::string name;
  size_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::text;
  std::vector<PlyElement> elements;
  size_t size = 0;  ///< bytes up to and with the line end_header
};

/// What is wrong with the file; parse_ply adds its name.
struct PlyFault {
  std::string what;
};

PlyType type_of(const std::string& word) {
  static constexpr struct {
    const char *name, *other_name;
  } names[] = {{"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},   {"ushort", "uint16"},
               {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}};
  for (int i = 0; i < 8; ++i)
    if (word == names[i].name || word == names[i].other_name) return static_cast<PlyType>(i);
  throw PlyFault{"its header names an unknown type '" + word + "'"};
}

PlyEncoding encoding_of(const std::string& word) {
  if (word == "ascii") return PlyEncoding::text;
  if (word == "binary_little_endian") return PlyEncoding::little_endian;
  if (word == "binary_big_endian") return PlyEncoding::big_endian;
  throw PlyFault{"its header names an unknown format '" + word + "'"};
}

PlyProperty property_of(std::istringstream& words) {
  PlyProperty property;
  std::string type, count_type;
  words >> type;
  if (type == "list") {
    property.is_list = true;
    words >> count_type >> type;
    property.count_type = type_of(count_type);
  }
  property.type = type_of(type);
  words >> property.name;
  return property;
}

PlyHeader parse_header(std::string_view bytes) {
  PlyHeader header;
  bool has_format = false;
  for (size_t begin = 0;;) {
    const size_t end = bytes.find('\n', begin);
    if (end == std::string_view::npos) throw PlyFault{"it ends inside its header"};
    std::istringstream words{std::string(bytes.substr(begin, end - begin))};
    std::string keyword, word;
    words >> keyword;
    if (begin == 0 && keyword != "ply") throw PlyFault{"it does not begin as a PLY file"};
    begin = end + 1;
    if (keyword == "format") {
      words >> word;
      header.encoding = encoding_of(word);
      has_format = true;
    } else if (keyword == "element") {
      PlyElement& element = header.elements.emplace_back();
      if (!(words >> element.name >> element.count))
        throw PlyFault{"its header has an element without a count"};
    } else if (keyword == "property") {
      if (header.elements.empty()) throw PlyFault{"its header has a property before any element"};
      header.elements.back().properties.push_back(property_of(words));
    } else if (keyword == "end_header") {
      header.size = begin;
      break;
    }
  }
  if (!has_format) throw PlyFault{"its header names no format"};
  return header;
}

/// Takes number after number from the file's body.
class PlyBody {
 public:
  PlyBody(std::string_view bytes, PlyEncoding encoding) : rest_(bytes), encoding_(encoding) {}

  double next(PlyType type) { return encoding_ == PlyEncoding::text ? next_word() : next_binary(type); }
  size_t bytes_left() const { return rest_.size(); }

 private:
  double next_word() {
    const size_t begin = rest_.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) throw PlyFault{"it is cut off"};
    rest_.remove_prefix(begin);
    double value = 0.0;
    const auto [end, failed] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (failed != std::errc{}) throw PlyFault{"it has a word where a number is expected"};
    rest_.remove_prefix(static_cast<size_t>(end - rest_.data()));
    return value;
  }

  double next_binary(PlyType type) {
    switch (type) {
      case PlyType::i8: return take<int8_t>();
      case PlyType::u8: return take<uint8_t>();
      case PlyType::i16: return take<int16_t>();
      case PlyType::u16: return take<uint16_t>();
      case PlyType::i32: return take<int32_t>();
      case PlyType::u32: return take<uint32_t>();
      case PlyType::f32: return static_cast<double>(take<float>());
      case PlyType::f64: return take<double>();
    }
    return 0.0;
  }

  template <typename T>
  T take() {
    if (rest_.size() < sizeof(T)) throw PlyFault{"it is cut off"};
    char bytes[sizeof(T)];
    std::memcpy(bytes, rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
    const bool file_is_little = encoding_ == PlyEncoding::little_endian;
    if (file_is_little != (std::endian::native == std::endian::little))
      std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  std::string_view rest_;
  PlyEncoding encoding_;
};

/// A whole number in [0, end) or a PlyFault.
uint32_t whole_number(double value, double end, const char* what) {
  if (!(value >= 0.0 && value < end) || value != std::floor(value)) throw PlyFault{what};
  return static_cast<uint32_t>(value);
}

std::vector<double> next_list(const PlyProperty& property, PlyBody& body) {
  const uint32_t count =
      whole_number(body.next(property.count_type), 4294967296.0, "it has a list of impossible length");
  if (count > body.bytes_left()) throw PlyFault{"it is cut off"};
  std::vector<double> values(count);
  for (double& value : values) value = body.next(property.type);
  return values;
}

void add_fan(const std::vector<double>& polygon, TriangleMesh& mesh) {
  std::vector<uint32_t> corners;
  corners.reserve(polygon.size());
  for (const double index : polygon)
    corners.push_back(whole_number(index, static_cast<double>(mesh.vertices_mm.size()),
                                   "a triangle names a vertex that does not exist"));
  for (size_t k = 2; k < corners.size(); ++k)
    mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
}

void read_element(const PlyElement& element, PlyBody& body, TriangleMesh& mesh) {
  if (element.properties.empty()) return;
  const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
  for (size_t i = 0; i < element.count; ++i) {
    Vec3f position = Vec3f::Zero();
    for (const PlyProperty& property : element.properties) {
      if (property.is_list) {
        const auto values = next_list(property, body);
        if (is_face && (property.name == "vertex_indices" || property.name == "vertex_index"))
          add_fan(values, mesh);
        continue;
      }
      const double value = body.next(property.type);
      if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z')
        position[property.name[0] - 'x'] = static_cast<float>(value);
    }
    if (is_vertex) mesh.vertices_mm.push_back(position);
  }
}

}  // namespace

TriangleMesh parse_ply(std::string_view bytes, const std::filesystem::path& path) {
  try {
    const PlyHeader header = parse_header(bytes);
    PlyBody body(bytes.substr(header.size), header.encoding);
    TriangleMesh mesh;
    for (const PlyElement& element : header.elements) read_element(element, body, mesh);
    return mesh;
  } catch (const PlyFault& fault) {
    throw Error(ErrorKind::invalid_input, "mesh " + path.string() + " cannot be used: " + fault.what);
  }
}

}  // namespace ream::reader
