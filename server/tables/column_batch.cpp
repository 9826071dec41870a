#include "tables/column_batch.hpp"

#include <cstring>
#include <stdexcept>

namespace ream::tables {

ColumnBatch::ColumnBatch(std::span<const Column> columns, size_t max_rows) : max_rows_(max_rows) {
  for (const Column& column : columns)
    columns_.push_back({column.type, std::vector<std::byte>(max_rows * value_bytes(column.type))});
}

std::byte* ColumnBatch::next(bool number) {
  Values& values = columns_.at(column_);
  if (number != (values.type == ColumnType::number))
    throw std::logic_error("a value of another type than column " + std::to_string(column_));
  if (full()) throw std::logic_error("more rows than there is place for");
  std::byte* const place = values.bytes.data() + rows_ * value_bytes(values.type);
  if (++column_ == columns_.size()) column_ = 0, ++rows_;
  return place;
}

void ColumnBatch::add(double value) { std::memcpy(next(true), &value, sizeof value); }

void ColumnBatch::add(int64_t value) {
  const bool flag = columns_[column_].type == ColumnType::flag;
  std::byte* const place = next(false);
  if (flag)
    *place = std::byte{value != 0};
  else
    std::memcpy(place, &value, sizeof value);
}

std::span<const std::byte> ColumnBatch::values(size_t column) const {
  const Values& values = columns_.at(column);
  return std::span(values.bytes).first(rows_ * value_bytes(values.type));
}

}  // namespace ream::tables
