#include "store/table_files.hpp"

#include <algorithm>
#include <fstream>
#include <numeric>

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
  names.reserve(columns.size());
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

/// Calls `bind` with the variable that holds this column's kind of value, and with its indicator.
template <typename Bind>
void bind_cell(RowCells& row, size_t place, Bind&& bind) {
  Cell& cell = row.cells[place];
  switch (row.columns[place].kind) {
    case Column::Kind::whole: return bind(cell.whole, cell.indicator);
    case Column::Kind::number: return bind(cell.number, cell.indicator);
    case Column::Kind::text: return bind(cell.text, cell.indicator);
  }
}

/// All rows, one after the other in `row`. Sorted by every column, so that both kinds of database give the
/// same order.
OpenStatement selection(Sql& sql, const std::string& table, RowCells& row) {
  const std::string list = joined(names_of(row.columns));
  OpenStatement statement(sql, "SELECT " + list + " FROM " + table + " ORDER BY " + list);
  for (size_t i = 0; i < row.cells.size(); ++i)
    bind_cell(row, i, [&](auto& value, auto& indicator) { statement.into(value, indicator); });
  return statement;
}

/// To be executed for what these of the row's columns hold each time.
soci::statement insertion(Sql& sql, const std::string& table, RowCells& row,
                          const std::vector<size_t>& places) {
  std::vector<std::string> names;
  names.reserve(places.size());
  for (const size_t place : places) names.push_back(row.columns[place].name);
  OpenStatement statement(
      sql, "INSERT INTO " + table + " (" + joined(names) + ") VALUES (" + joined(names, ":") + ")");
  for (const size_t place : places)
    bind_cell(row, place, [&](auto& value, auto& indicator) { statement.with(value, indicator); });
  return statement.prepared();
}

uint64_t write_table(Sql& sql, const std::string& table, const fs::path& file) {
  RowCells row(sql, table);
  OpenStatement statement = selection(sql, table, row);
  std::ofstream out(file, std::ios::binary);
  out << json(names_of(row.columns)).dump() << '\n';
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
  soci::statement insert = insertion(sql_, table_, row_, places);
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

void copy_tables(Sql& from, Sql& to) {
  const std::vector<std::string> tables = table_names();
  for (auto table = tables.rbegin(); table != tables.rend(); ++table)
    if (!columns_of(to, *table).empty()) to << "DELETE FROM " + *table;
  for (const std::string& table : tables) {
    RowCells row(from, table);
    if (row.columns.empty()) continue;
    std::vector<size_t> places(row.columns.size());
    std::iota(places.begin(), places.end(), size_t{0});
    soci::statement insert = insertion(to, table, row, places);
    selection(from, table, row).each([&] { insert.execute(true); });
    advance_identity(to, table);
  }
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
