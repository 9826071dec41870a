#include "session/scoring/export_table.hpp"

namespace ream::session {
using nlohmann::json;
namespace {

bool looks_like_formula(const std::string& text) {
  return !text.empty() && std::string("=+-@\t\r").find(text.front()) != std::string::npos;
}

std::string in_quotes(const std::string& text) {
  const std::string safe = looks_like_formula(text) ? "'" + text : text;
  if (safe.find_first_of(",\"\r\n") == std::string::npos) return safe;
  std::string field = "\"";
  for (const char c : safe) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + "\"";
}

std::string cell_text(const json& cell) {
  if (cell.is_discarded() || cell.is_null()) return {};
  if (cell.is_string()) return in_quotes(cell.get<std::string>());
  if (cell.is_boolean()) return cell.get<bool>() ? "1" : "0";
  if (!cell.is_array()) return cell.dump();
  std::string joined;
  for (const json& part : cell) joined += (joined.empty() ? "" : ";") + part.get<std::string>();
  return in_quotes(joined);
}

}  // namespace

std::string csv_of(const ExportTable& table) {
  std::string text;
  for (size_t i = 0; i < table.columns.size(); ++i)
    text += (i > 0 ? "," : "") + in_quotes(table.columns[i].name);
  text += "\r\n";
  for (const auto& row : table.rows) {
    for (size_t i = 0; i < row.size(); ++i) text += (i > 0 ? "," : "") + cell_text(row[i]);
    text += "\r\n";
  }
  return text;
}

json json_of(const ExportTable& table) {
  json rows = json::array();
  for (const auto& row : table.rows) {
    json object = json::object();
    for (size_t i = 0; i < row.size(); ++i)
      if (!row[i].is_discarded()) object[table.columns[i].name] = row[i];
    rows.push_back(std::move(object));
  }
  return rows;
}

}  // namespace ream::session
