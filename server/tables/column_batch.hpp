#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace ream::tables {

enum class ColumnType {
  number,  ///< double
  count,   ///< 64-bit integer
  flag     ///< true or false
};

/// Bytes of a value in a ColumnBatch.
constexpr size_t value_bytes(ColumnType type) { return type == ColumnType::flag ? 1 : 8; }

/// A column of a table; its texts outlive all that is made of it.
struct Column {
  std::string_view name, unit;  ///< unit "" where there is none
  std::string_view meaning;     ///< a sentence for people
  ColumnType type = ColumnType::number;
};

/// Some rows of a table, each column for itself. Memory for `max_rows` rows from the beginning.
class ColumnBatch {
 public:
  ColumnBatch(std::span<const Column> columns, size_t max_rows);

  /// The next value of the row that is being made, column by column; a row begins where the one before has
  /// all its values. Whole numbers are those of columns that are no number. Throws std::logic_error for a
  /// value of another type and where there is no place left.
  void add(double value);
  void add(int64_t value);

  size_t rows() const { return rows_; }  ///< whole ones
  bool full() const { return rows_ == max_rows_; }
  void clear() { rows_ = 0; }
  /// The values of a column as they lie in memory: doubles, int64_t, or a byte 0 or 1 for each flag.
  std::span<const std::byte> values(size_t column) const;

 private:
  struct Values {
    ColumnType type;
    std::vector<std::byte> bytes;
  };
  /// Where the next value goes.
  std::byte* next(bool number);

  std::vector<Values> columns_;
  size_t max_rows_, rows_ = 0, column_ = 0;
};

}  // namespace ream::tables
