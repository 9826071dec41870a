#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "fe/id_set.hpp"
#include "fe/line_reader.hpp"

namespace ream::fe {

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
    uint64_t elements = 0, least_node = UINT64_MAX, greatest_node = 0;
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

}  // namespace ream::fe
