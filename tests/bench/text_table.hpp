#pragma once
#include <iosfwd>
#include <string>
#include <vector>

namespace ream::bench {

/// A table for people: a title, column heads, and lines of a label and numbers.
struct TextTable {
  std::string title, corner;
  std::vector<std::string> columns;
  struct Line {
    std::string label;
    std::vector<double> values;  ///< not a number: no value, printed as a dash
  };
  std::vector<Line> lines;

  /// Numbers with `decimals` places. Does nothing without a stream.
  void print(std::ostream* out, int decimals) const;
};

}  // namespace ream::bench
