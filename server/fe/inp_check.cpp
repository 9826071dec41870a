#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "fe/line_reader.hpp"
#include "fe/mesh_file_checks.hpp"

namespace ream::fe {
namespace {

/// Where something begins in a text file.
struct FilePlace {
  uint64_t byte = 0, line = 0;
};

/// What an input file holds, found in one pass; coordinates and sets stay in the file.
struct InpOutline {
  IdSet nodes, elements, used_nodes;
  bool nodes_rise = true;  ///< their ids
  struct NodeMark {
    uint64_t id = 0;
    FilePlace place;
  };
  std::vector<NodeMark>
      node_marks;  ///< one of every few thousand nodes, the first of each section among them

  struct ElementBlock {
    FilePlace place;
    uint64_t elements = 0, min_node = UINT64_MAX, greatest_node = 0;
  };
  std::vector<ElementBlock> element_blocks;  ///< lines that follow each other

  struct SetPart {
    FilePlace place;
    bool generate = false;
    bool whole_block = false;  ///< elements of an *ELEMENT with ELSET, whose lines begin here
  };
  std::map<std::string, std::vector<SetPart>> sets;

  struct Section {
    std::string set, material;
    uint64_t line = 0;
  };
  std::vector<Section> sections;
  std::map<std::string, bool> materials;  ///< whether an *ELASTIC was given
};

/// Throws Error invalid_input naming the line of what is wrong in itself: ids of 0 or given twice, lines that
/// cannot be read, other elements than C3D8, E or nu that cannot be.
InpOutline outline_of(LineReader& lines, const std::string& file, const Progress& progress);

/// `file` line `line`: why.
[[noreturn]] void refuse_line(const std::string& file, uint64_t line, const std::string& why);

constexpr uint64_t nodes_between_marks = 1 << 14, elements_of_block = 1 << 14;
constexpr uint64_t max_id = 999'999'999;
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
    if (id == 0 || id > max_id) refuse("node id " + std::to_string(id) + " is not from 1 to 999,999,999");
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
    if (id == 0 || id > max_id) refuse("element id " + std::to_string(id) + " is not from 1 to 999,999,999");
    if (!outline_.elements.insert(id)) refuse("element " + std::to_string(id) + " is given twice");
    if (new_section_ && !after_keyword_.empty())
      outline_.sets[after_keyword_].push_back({{lines_.byte(), lines_.number()}, false, true});
    if (new_section_ || outline_.element_blocks.back().elements == elements_of_block)
      outline_.element_blocks.push_back({{lines_.byte(), lines_.number()}});
    new_section_ = false;
    InpOutline::ElementBlock& block = outline_.element_blocks.back();
    ++block.elements;
    for (int k = 0; k < 8; ++k) {
      if (corners[k] == 0 || corners[k] > max_id)
        refuse("element " + std::to_string(id) + " names node " + std::to_string(corners[k]));
      if (std::find(corners, corners + k, corners[k]) != corners + k)
        refuse("element " + std::to_string(id) + " names node " + std::to_string(corners[k]) + " twice");
      outline_.used_nodes.insert(corners[k]);
    }
    block.min_node = std::min(block.min_node, *std::min_element(corners, corners + 8));
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

void refuse_line(const std::string& file, uint64_t line, const std::string& why) {
  throw Error(ErrorKind::invalid_input, file + " line " + std::to_string(line) + ": " + why);
}

InpOutline outline_of(LineReader& lines, const std::string& file, const Progress& progress) {
  lines.seek(0, 1);
  return OutlineReader(lines, file).read(progress);
}

class InpCheck {
 public:
  InpCheck(const std::filesystem::path& path, const MemoryBudget& budget, const ElementVisitor& visit)
      : file_(path.string()), lines_(path), budget_(budget), sum_(visit) {}

  MeshFacts check(const Progress& progress) {
    outline_ = outline_of(lines_, file_, part_of(progress, 0.0, 0.5));
    if (outline_.elements.size() == 0) refuse("holds no elements");
    if (const uint64_t id = outline_.used_nodes.first_not_in(outline_.nodes))
      refuse("node " + std::to_string(id) + " is named by an element and given nowhere");
    if (const uint64_t id = outline_.nodes.first_not_in(outline_.used_nodes))
      refuse("node " + std::to_string(id) + " belongs to no element");
    check_sections();
    check_shapes(part_of(progress, 0.5, 1.0));
    return {outline_.nodes.size(), outline_.elements.size(), outline_.materials.size(), sum_.volume_mm3(),
            sum_.min_jacobian_mm3()};
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(ErrorKind::invalid_input, file_ + ": " + why);
  }

  /// Every element in exactly one of them.
  void check_sections() {
    IdSet assigned;
    for (const InpOutline::Section& section : outline_.sections) {
      const auto material = outline_.materials.find(section.material);
      if (material == outline_.materials.end() || !material->second)
        refuse_line(file_, section.line, "material " + section.material + " has no *ELASTIC");
      const auto set = outline_.sets.find(section.set);
      if (set == outline_.sets.end())
        refuse_line(file_, section.line, "there is no element set " + section.set);
      for (const InpOutline::SetPart& part : set->second)
        for_each_id(part, [&](uint64_t id) {
          if (!outline_.elements.contains(id))
            refuse_line(
                file_, lines_.number(),
                "set " + section.set + " names element " + std::to_string(id) + ", which there is not");
          if (!assigned.insert(id))
            refuse_line(file_, lines_.number(),
                        "element " + std::to_string(id) + " has more than one section");
        });
    }
    if (const uint64_t id = outline_.elements.first_not_in(assigned))
      refuse("element " + std::to_string(id) + " has no section");
  }

  template <typename Use>
  void for_each_id(const InpOutline::SetPart& part, Use&& use) {
    lines_.seek(part.place.byte, part.place.line);
    std::string_view line;
    while (lines_.next(line) && (!line.starts_with('*') || line.starts_with("**"))) {
      if (line.starts_with('*')) continue;
      const char* at = line.data();
      const char* const end = at + line.size();
      uint64_t id = 0;
      if (part.whole_block) {
        if (read_id(at, end, id)) use(id);
      } else if (part.generate) {
        uint64_t last = 0, step = 1;
        if (!read_id(at, end, id) || !read_id(at, end, last) || (at < end && !read_id(at, end, step)) ||
            step == 0)
          refuse_line(file_, lines_.number(), "is not 'first, last, step'");
        for (; id <= last; id += step) use(id);
      } else {
        std::vector<uint64_t> ids;
        while (at < end) {
          if (!read_id(at, end, id)) refuse_line(file_, lines_.number(), "is no list of ids");
          ids.push_back(id);
        }
        if (ids.size() > 16)
          refuse_line(file_, lines_.number(), "has more than 16 ids, which CalculiX refuses");
        for (const uint64_t listed : ids) use(listed);
      }
    }
  }

  /// Blocks of elements, as many at a time as have their nodes at hand.
  void check_shapes(const Progress& progress) {
    const auto& blocks = outline_.element_blocks;
    for (size_t first = 0; first < blocks.size();) {
      progress(static_cast<double>(first) / static_cast<double>(blocks.size()), "checking");
      uint64_t least = blocks[first].min_node, greatest = blocks[first].greatest_node;
      size_t end = first + 1;
      for (; end < blocks.size(); ++end) {
        const uint64_t low = std::min(least, blocks[end].min_node),
                       high = std::max(greatest, blocks[end].greatest_node);
        if (high - low >= max_nodes_at_hand(budget_)) break;
        least = low;
        greatest = high;
      }
      load_nodes(least, greatest);
      for (; first < end; ++first) check_block(blocks[first]);
    }
  }

  void load_nodes(uint64_t least, uint64_t greatest) {
    first_node_ = least;
    if (greatest - least >= max_nodes_at_hand(budget_))
      refuse("elements name nodes too far apart to be checked within --memory-mb");
    nodes_.assign(greatest - least + 1, Vec3::Zero());
    const auto& marks = outline_.node_marks;
    size_t mark = 0;
    if (outline_.nodes_rise)
      while (mark + 1 < marks.size() && marks[mark + 1].id <= least) ++mark;
    for (; mark < marks.size(); ++mark) {
      if (outline_.nodes_rise && marks[mark].id > greatest) return;
      read_nodes(marks[mark].place, mark + 1 < marks.size() ? marks[mark + 1].place.byte : UINT64_MAX);
    }
  }

  void read_nodes(const FilePlace& place, uint64_t end_byte) {
    lines_.seek(place.byte, place.line);
    std::string_view line;
    while (lines_.next(line) && lines_.byte() < end_byte &&
           (!line.starts_with('*') || line.starts_with("**"))) {
      const char* at = line.data();
      const char* const end = at + line.size();
      uint64_t id = 0;
      if (!read_id(at, end, id) || id < first_node_ || id - first_node_ >= nodes_.size()) continue;
      for (int k = 0; k < 3; ++k) read_real(at, end, nodes_[id - first_node_][k]);
    }
  }

  void check_block(const InpOutline::ElementBlock& block) {
    lines_.seek(block.place.byte, block.place.line);
    std::string_view line;
    for (uint64_t i = 0; i < block.elements && lines_.next(line);) {
      if (line.starts_with('*')) continue;
      const char* at = line.data();
      const char* const end = at + line.size();
      uint64_t id = 0, corner = 0;
      read_id(at, end, id);
      HexCorners corners;
      for (Vec3& c : corners) {
        read_id(at, end, corner);
        c = nodes_[corner - first_node_];
      }
      if (!sum_.add(corners))
        refuse_line(file_, lines_.number(),
                    "element " + std::to_string(id) + " has a Jacobian that is not positive");
      ++i;
    }
  }

  const std::string file_;
  LineReader lines_;
  const MemoryBudget& budget_;
  HexSum sum_;
  InpOutline outline_;
  std::vector<Vec3> nodes_;
  uint64_t first_node_ = 0;
};

}  // namespace

MeshFacts check_inp(const std::filesystem::path& path, const MemoryBudget& budget, const Progress& progress,
                    const ElementVisitor& visit) {
  return InpCheck(path, budget, visit).check(progress);
}

}  // namespace ream::fe
