#include "geometry/off.hpp"

#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace ream {
namespace {

/// What is wrong with the file; parse_off adds its name.
struct Fault {
  std::string what;
};

/// Takes line after line, words apart, without comments and empty lines.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  std::vector<std::string_view> next() {
    while (!rest_.empty()) {
      const size_t end = std::min(rest_.find('\n'), rest_.size());
      std::string_view line = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      line = line.substr(0, line.find('#'));
      std::vector<std::string_view> words;
      for (size_t begin = 0; (begin = line.find_first_not_of(" \t\r", begin)) != std::string_view::npos;) {
        const size_t stop = std::min(line.find_first_of(" \t\r", begin), line.size());
        words.push_back(line.substr(begin, stop - begin));
        begin = stop;
      }
      if (!words.empty()) return words;
    }
    throw Fault{"it is cut off"};
  }

 private:
  std::string_view rest_;
};

template <class Number>
Number number_of(std::string_view word) {
  Number value{};
  const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (failed != std::errc{} || end != word.data() + word.size())
    throw Fault{"it has a word where a number is expected"};
  return value;
}

void add_face(const std::vector<std::string_view>& words, TriangleMesh& mesh) {
  const auto corners = number_of<uint32_t>(words[0]);
  if (corners >= words.size()) throw Fault{"a face names fewer vertices than it says"};
  std::vector<uint32_t> indices;
  for (uint32_t i = 1; i <= corners; ++i) {
    indices.push_back(number_of<uint32_t>(words[i]));
    if (indices.back() >= mesh.vertices_mm.size())
      throw Fault{"a triangle names a vertex that does not exist"};
  }
  for (size_t k = 2; k < indices.size(); ++k)
    mesh.triangles.push_back({indices[0], indices[k - 1], indices[k]});
}

TriangleMesh parse(std::string_view text) {
  Lines lines(text);
  std::vector<std::string_view> counts = lines.next();
  if (!counts[0].ends_with("OFF")) throw Fault{"it does not begin as an OFF file"};
  counts.erase(counts.begin());
  if (!counts.empty() && counts[0] == "BINARY")
    throw Fault{"it is a binary OFF file; only text is understood"};
  if (counts.empty()) counts = lines.next();
  if (counts.size() < 2) throw Fault{"it does not say how many vertices and faces it has"};
  const auto vertices = number_of<uint32_t>(counts[0]), faces = number_of<uint32_t>(counts[1]);
  TriangleMesh mesh;
  for (uint32_t i = 0; i < vertices; ++i) {
    const std::vector<std::string_view> words = lines.next();
    if (words.size() < 3) throw Fault{"vertex " + std::to_string(i) + " has fewer than three coordinates"};
    mesh.vertices_mm.emplace_back(number_of<float>(words[0]), number_of<float>(words[1]),
                                  number_of<float>(words[2]));
  }
  for (uint32_t i = 0; i < faces; ++i) add_face(lines.next(), mesh);
  return mesh;
}

}  // namespace

TriangleMesh parse_off(std::string_view text, const std::filesystem::path& path) {
  try {
    return parse(text);
  } catch (const Fault& fault) {
    throw Error(ErrorKind::invalid_input, "mesh " + path.string() + " cannot be used: " + fault.what);
  }
}

}  // namespace ream
