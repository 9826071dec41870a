#include "store/table_files.hpp"

#include <algorithm>
#include <fstream>

#include "core/error.hpp"
#include "core/json.hpp"
#include "store/dialect.hpp"
#include "store/migrations.hpp"
#include "store/sql.hpp"

namespace ream::store {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

fs::path file_of(const fs::path& folder, const std::string& table) { return folder / (table + ".jsonl"); }

/// A value of one column, read from or written to the table row by row.
struct Cell {
  soci::indicator indicator = soci::i_null;
  std::string text;
  long long whole = 0;
  double number = 0.0;
};

/// The columns of a table and a cell for each, which stay where they are.
struct RowCells {
  RowCells(Sql& sql, const std::string& table) : columns(columns_of(sql, table)), cells(columns.size()) {}
  std::vector<Column> columns;
  std::vector<Cell> cells;
};

std::vector<std::string> names_of(const std::vector<Column>& columns) {
  std::vector<std::string> names;
  for (const Column& column : columns) names.push_back(column.name);
  return names;
}

std::string joined(const std::vector<std::string>& words, const std::string& before = {}) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + before + word;
  return text;
}

json value_of(const Column& column, const Cell& cell) {
  if (cell.indicator == soci::i_null) return nullptr;
  if (column.kind == Column::Kind::whole) return cell.whole;
  if (column.kind == Column::Kind::number) return cell.number;
  return cell.text;
}

/// Sorted by every column, so that both kinds of database give the same order.
uint64_t write_table(Sql& sql, const std::string& table, const fs::path& file) {
  RowCells row(sql, table);
  const std::vector<std::string> names = names_of(row.columns);
  const std::string list = joined(names);
  OpenStatement statement(sql, "SELECT " + list + " FROM " + table + " ORDER BY " + list);
  for (size_t i = 0; i < row.cells.size(); ++i) {
    Cell& cell = row.cells[i];
    if (row.columns[i].kind == Column::Kind::whole)
      statement.into(cell.whole, cell.indicator);
    else if (row.columns[i].kind == Column::Kind::number)
      statement.into(cell.number, cell.indicator);
    else
      statement.into(cell.text, cell.indicator);
  }
  std::ofstream out(file, std::ios::binary);
  out << json(names).dump() << '\n';
  uint64_t count = 0;
  statement.each([&] {
    json line = json::array();
    for (size_t i = 0; i < row.cells.size(); ++i) line.push_back(value_of(row.columns[i], row.cells[i]));
    out << line.dump() << '\n';
    ++count;
  });
  out.close();
  if (!out) throw Error(ErrorKind::io, "cannot write " + file.string());
  return count;
}

/// Reads a table's file into the table.
class TableReader {
 public:
  TableReader(Sql& sql, const std::string& table, const fs::path& file)
      : sql_(sql), table_(table), name_(file.filename()), row_(sql, table), in_(file, std::ios::binary) {}

  /// Returns the number of rows.
  uint64_t read();

 private:
  json next_line(size_t length);
  std::vector<size_t> read_heading();
  soci::statement insertion(const std::vector<size_t>& places);
  void set(size_t place, const json& value);
  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(ErrorKind::invalid_input, name_ + ", line " + std::to_string(line_) + ": " + why);
  }

  Sql& sql_;
  const std::string table_, name_;
  RowCells row_;
  std::ifstream in_;
  uint64_t line_ = 0;
};

/// An array of that length, or of any; null at the end.
json TableReader::next_line(size_t length) {
  std::string text;
  ++line_;
  if (!std::getline(in_, text)) return nullptr;
  json line = parse_json_or_discard(text);
  if (!line.is_array() || (length != 0 && line.size() != length)) refuse("is no row of table " + table_);
  return line;
}

/// For each column of the file its place in the table.
std::vector<size_t> TableReader::read_heading() {
  std::vector<size_t> places;
  for (const json& name : next_line(0)) {
    const auto found = std::find_if(row_.columns.begin(), row_.columns.end(),
                                    [&](const Column& column) { return name == column.name; });
    if (found == row_.columns.end()) refuse("the table " + table_ + " has no column " + name.dump());
    places.push_back(static_cast<size_t>(found - row_.columns.begin()));
  }
  if (places.empty()) refuse("names no columns");
  return places;
}

soci::statement TableReader::insertion(const std::vector<size_t>& places) {
  std::vector<std::string> names;
  for (const size_t place : places) names.push_back(row_.columns[place].name);
  OpenStatement statement(
      sql_, "INSERT INTO " + table_ + " (" + joined(names) + ") VALUES (" + joined(names, ":") + ")");
  for (const size_t place : places) {
    Cell& cell = row_.cells[place];
    if (row_.columns[place].kind == Column::Kind::whole)
      statement.with(cell.whole, cell.indicator);
    else if (row_.columns[place].kind == Column::Kind::number)
      statement.with(cell.number, cell.indicator);
    else
      statement.with(cell.text, cell.indicator);
  }
  return statement.prepared();
}

void TableReader::set(size_t place, const json& value) {
  Cell& cell = row_.cells[place];
  cell.indicator = value.is_null() ? soci::i_null : soci::i_ok;
  const Column& column = row_.columns[place];
  if (value.is_null()) return;
  const bool is_whole =
      value.is_number_integer() && (!value.is_number_unsigned() || value.get<uint64_t>() <= INT64_MAX);
  if (column.kind == Column::Kind::whole && is_whole)
    cell.whole = value;
  else if (column.kind == Column::Kind::number && value.is_number())
    cell.number = value;
  else if (column.kind == Column::Kind::text && value.is_string())
    cell.text = storable(value.get_ref<const std::string&>());
  else
    refuse("column " + column.name + " holds a value of another kind");
}

uint64_t TableReader::read() {
  const std::vector<size_t> places = read_heading();
  soci::statement insert = insertion(places);
  uint64_t count = 0;
  for (json line = next_line(places.size()); !line.is_null(); line = next_line(places.size())) {
    for (size_t i = 0; i < places.size(); ++i) set(places[i], line[i]);
    insert.execute(true);
    ++count;
  }
  advance_identity(sql_, table_);
  return count;
}

}  // namespace

std::vector<TableFile> write_table_files(Database& database, const fs::path& folder) {
  return database.read_at_length([&](Sql& sql) {
    std::vector<TableFile> files;
    for (const std::string& table : table_names())
      files.push_back({table, write_table(sql, table, file_of(folder, table))});
    return files;
  });
}

std::vector<std::string> filled_tables(Database& database) {
  return database.read([](Sql& sql) {
    std::vector<std::string> filled;
    for (const std::string& table : table_names()) {
      long long rows = 0;
      sql << "SELECT count(*) FROM " + table, into(rows);
      if (rows > 0) filled.push_back(table);
    }
    return filled;
  });
}

void read_table_files(Database& database, const fs::path& folder, const std::vector<TableFile>& files,
                      const std::function<void()>& before_commit, const Progress& progress,
                      OldCredentials credentials) {
  std::vector<std::string> tables = table_names();
  database.run_at_length([&](Sql& sql) {
    for (auto table = tables.rbegin(); table != tables.rend(); ++table) sql << "DELETE FROM " + *table;
    for (const std::string& table : tables) {
      progress(static_cast<double>(&table - tables.data()) / static_cast<double>(tables.size()),
               "filling the database");
      const auto file = std::find_if(files.begin(), files.end(),
                                     [&](const TableFile& each) { return each.table == table; });
      if (file == files.end()) continue;
      if (TableReader(sql, table, file_of(folder, table)).read() != file->rows)
        throw Error(ErrorKind::invalid_input, file_of(folder, table).filename().string() +
                                                  " does not hold the " + std::to_string(file->rows) +
                                                  " rows that it should");
    }
    if (credentials == OldCredentials::tokens) sql << "DELETE FROM credentials WHERE kind <> 'token'";
    if (credentials == OldCredentials::none) sql << "DELETE FROM credentials";
    before_commit();
  });
}

}  // namespace ream::store
