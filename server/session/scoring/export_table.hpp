#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ream::session {

/// A column of a table for statistics.
struct ExportColumn {
  std::string name;   ///< ends in its unit
  std::string unit;   ///< "mm3"; empty: none
  std::string words;  ///< what it is
};

struct ExportTable {
  std::string name;
  std::vector<ExportColumn> columns;
  std::vector<std::vector<nlohmann::json>> rows;  ///< null: not known; discarded: was never asked or answered
};

/// RFC 4180 with a line of column names. A text that a spreadsheet would take for a formula begins with '.
std::string csv_of(const ExportTable& table);
/// A list of objects by column name.
nlohmann::json json_of(const ExportTable& table);

}  // namespace ream::session
