#include <algorithm>

#include "core/error.hpp"
#include "fe/inp_outline.hpp"
#include "fe/mesh_file_checks.hpp"

namespace ream::fe {
namespace {

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
            sum_.least_jacobian_mm3()};
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
      uint64_t least = blocks[first].least_node, greatest = blocks[first].greatest_node;
      size_t end = first + 1;
      for (; end < blocks.size(); ++end) {
        const uint64_t low = std::min(least, blocks[end].least_node),
                       high = std::max(greatest, blocks[end].greatest_node);
        if (high - low >= most_nodes_at_hand(budget_)) break;
        least = low;
        greatest = high;
      }
      load_nodes(least, greatest);
      for (; first < end; ++first) check_block(blocks[first]);
    }
  }

  void load_nodes(uint64_t least, uint64_t greatest) {
    first_node_ = least;
    if (greatest - least >= most_nodes_at_hand(budget_))
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
