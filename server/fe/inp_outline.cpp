#include "fe/inp_outline.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace ream::fe {
namespace {

constexpr uint64_t nodes_between_marks = 1 << 14, elements_of_block = 1 << 14;
constexpr uint64_t greatest_id = 999'999'999;
constexpr uint64_t lines_between_progress = 1 << 18;

std::string upper(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (c != ' ' && c != '\r' && c != '\t')
      result += static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
  return result;
}

/// A line that begins with one star: "*SOLID SECTION, ELSET=A" has the name SOLIDSECTION and ELSET -> A.
struct Keyword {
  std::string name;
  std::map<std::string, std::string> parameters;

  explicit Keyword(std::string_view line) {
    const std::string text = upper(line.substr(1));
    for (size_t at = 0; at <= text.size();) {
      const size_t comma = std::min(text.find(',', at), text.size()), equals = text.find('=', at);
      const std::string word = text.substr(at, std::min(comma, equals) - at);
      if (at == 0)
        name = word;
      else if (!word.empty())
        parameters[word] = equals < comma ? text.substr(equals + 1, comma - equals - 1) : "";
      at = comma + 1;
    }
  }
  bool has(const char* parameter) const { return parameters.contains(parameter); }
  std::string of(const char* parameter) const {
    const auto found = parameters.find(parameter);
    return found == parameters.end() ? "" : found->second;
  }
};

class OutlineReader {
 public:
  OutlineReader(LineReader& lines, const std::string& file) : lines_(lines), file_(file) {}

  InpOutline read(const Progress& progress) {
    std::string_view line;
    for (uint64_t count = 0; lines_.next(line); ++count) {
      if (count % lines_between_progress == 0)
        progress(static_cast<double>(lines_.byte()) / static_cast<double>(lines_.file_bytes()), "checking");
      if (line.starts_with("**")) continue;
      if (line.starts_with('*')) {
        begin(Keyword(line), line.size());
      } else if (in_ == In::nodes) {
        node(line);
      } else if (in_ == In::elements) {
        element(line);
      } else if (in_ == In::elastic) {
        elastic(line);
      }
    }
    return std::move(outline_);
  }

 private:
  enum class In { other, nodes, elements, elastic };

  [[noreturn]] void refuse(const std::string& why) const { refuse_line(file_, lines_.number(), why); }

  void begin(const Keyword& keyword, size_t line_bytes) {
    in_ = In::other;
    new_section_ = true;
    after_keyword_.clear();
    if (keyword.name == "NODE") {
      in_ = In::nodes;
    } else if (keyword.name == "ELEMENT") {
      if (keyword.of("TYPE") != "C3D8")
        refuse("elements of type " + keyword.of("TYPE") + ", C3D8 is expected");
      in_ = In::elements;
      after_keyword_ = keyword.of("ELSET");
    } else if (keyword.name == "ELSET") {
      const FilePlace behind{lines_.byte() + line_bytes + 1, lines_.number() + 1};
      outline_.sets[keyword.of("ELSET")].push_back({behind, keyword.has("GENERATE"), false});
    } else if (keyword.name == "MATERIAL") {
      material_ = keyword.of("NAME");
      if (!outline_.materials.emplace(material_, false).second)
        refuse("material " + material_ + " is given twice");
    } else if (keyword.name == "ELASTIC") {
      in_ = In::elastic;
    } else if (keyword.name == "SOLIDSECTION") {
      outline_.sections.push_back({keyword.of("ELSET"), keyword.of("MATERIAL"), lines_.number()});
    }
  }

  void node(std::string_view line) {
    const char* at = line.data();
    const char* const end = at + line.size();
    uint64_t id = 0;
    double x = 0.0;
    if (!read_id(at, end, id)) refuse("is not 'id, x, y, z'");
    for (int k = 0; k < 3; ++k)
      if (!read_real(at, end, x) || !std::isfinite(x))
        refuse("node " + std::to_string(id) + " has no three coordinates");
    if (id == 0 || id > greatest_id)
      refuse("node id " + std::to_string(id) + " is not from 1 to 999,999,999");
    if (!outline_.nodes.insert(id)) refuse("node " + std::to_string(id) + " is given twice");
    outline_.nodes_rise = outline_.nodes_rise && id > last_node_;
    last_node_ = id;
    if (new_section_ || outline_.nodes.size() % nodes_between_marks == 0)
      outline_.node_marks.push_back({id, {lines_.byte(), lines_.number()}});
    new_section_ = false;
  }

  void element(std::string_view line) {
    const char* at = line.data();
    const char* const end = at + line.size();
    uint64_t id = 0, corners[8];
    if (!read_id(at, end, id)) refuse("is not 'id, eight nodes'");
    for (uint64_t& corner : corners)
      if (!read_id(at, end, corner)) refuse("element " + std::to_string(id) + " has no eight nodes");
    if (at != end) refuse("element " + std::to_string(id) + " has more than eight nodes");
    if (id == 0 || id > greatest_id)
      refuse("element id " + std::to_string(id) + " is not from 1 to 999,999,999");
    if (!outline_.elements.insert(id)) refuse("element " + std::to_string(id) + " is given twice");
    if (new_section_ && !after_keyword_.empty())
      outline_.sets[after_keyword_].push_back({{lines_.byte(), lines_.number()}, false, true});
    if (new_section_ || outline_.element_blocks.back().elements == elements_of_block)
      outline_.element_blocks.push_back({{lines_.byte(), lines_.number()}});
    new_section_ = false;
    InpOutline::ElementBlock& block = outline_.element_blocks.back();
    ++block.elements;
    for (int k = 0; k < 8; ++k) {
      if (corners[k] == 0 || corners[k] > greatest_id)
        refuse("element " + std::to_string(id) + " names node " + std::to_string(corners[k]));
      if (std::find(corners, corners + k, corners[k]) != corners + k)
        refuse("element " + std::to_string(id) + " names node " + std::to_string(corners[k]) + " twice");
      outline_.used_nodes.insert(corners[k]);
    }
    block.least_node = std::min(block.least_node, *std::min_element(corners, corners + 8));
    block.greatest_node = std::max(block.greatest_node, *std::max_element(corners, corners + 8));
  }

  void elastic(std::string_view line) {
    const char* at = line.data();
    double e = 0.0, nu = 0.0;
    if (!read_real(at, line.data() + line.size(), e) || !read_real(at, line.data() + line.size(), nu))
      refuse("is not 'E, nu'");
    if (!(e > 0.0) || !std::isfinite(e) || !(nu > -1.0 && nu < 0.5))
      refuse("material " + material_ + " needs E > 0 and -1 < nu < 0.5");
    if (material_.empty()) refuse("*ELASTIC without a *MATERIAL");
    outline_.materials[material_] = true;
    in_ = In::other;
  }

  LineReader& lines_;
  const std::string& file_;
  InpOutline outline_;
  In in_ = In::other;
  bool new_section_ = true;
  std::string after_keyword_, material_;
  uint64_t last_node_ = 0;
};

}  // namespace

void refuse_line(const std::string& file, uint64_t line, const std::string& why) {
  throw Error(ErrorKind::invalid_input, file + " line " + std::to_string(line) + ": " + why);
}

InpOutline outline_of(LineReader& lines, const std::string& file, const Progress& progress) {
  lines.seek(0, 1);
  return OutlineReader(lines, file).read(progress);
}

}  // namespace ream::fe
