#include "bench/text_table.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>

namespace ream::bench {

void TextTable::print(std::ostream* out, int decimals) const {
  if (out == nullptr) return;
  constexpr size_t least_width = 10;
  size_t label_width = corner.size();
  for (const Line& line : lines) label_width = std::max(label_width, line.label.size());
  const auto width_of = [least_width](const std::string& column) {
    return static_cast<int>(std::max(column.size() + 2, least_width));
  };
  *out << '\n'
       << title << '\n'
       << std::left << std::setw(static_cast<int>(label_width)) << corner << std::right;
  for (const std::string& column : columns) *out << std::setw(width_of(column)) << column;
  *out << '\n' << std::fixed << std::setprecision(decimals);
  for (const Line& line : lines) {
    *out << std::left << std::setw(static_cast<int>(label_width)) << line.label << std::right;
    for (size_t i = 0; i < line.values.size(); ++i) {
      *out << std::setw(width_of(columns[i]));
      if (std::isnan(line.values[i]))
        *out << "-";
      else
        *out << line.values[i];
    }
    *out << '\n';
  }
  *out << std::defaultfloat << std::flush;
}

}  // namespace ream::bench
