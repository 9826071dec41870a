#include "tables/parquet_file.hpp"

#include <zstd.h>

#include <new>

#include "core/error.hpp"

namespace ream::tables {
namespace {

constexpr std::string_view magic = "PAR1";
constexpr int zstd_level = 3;

// Numbers of parquet.thrift.
constexpr int32_t boolean_type = 0, int64_type = 2, double_type = 5;
constexpr int32_t required = 0;
constexpr int32_t plain = 0, rle = 3;
constexpr int32_t zstd_codec = 6;
constexpr int32_t data_page = 0;
constexpr int32_t format_version = 2;

int32_t parquet_type(ColumnType type) {
  switch (type) {
    case ColumnType::number: return double_type;
    case ColumnType::count: return int64_type;
    case ColumnType::flag: break;
  }
  return boolean_type;
}

/// Writes structs in Thrift's compact protocol
/// (https://github.com/apache/thrift/blob/master/doc/specs/thrift-compact-protocol.md). Fields in the order
/// of their numbers.
class CompactStruct {
 public:
  enum Type : uint8_t { i32_type = 5, i64_type = 6, binary_type = 8, list_type = 9, struct_type = 12 };

  explicit CompactStruct(std::string& out) : out_(out) {}
  ~CompactStruct() { out_ += '\0'; }
  CompactStruct(const CompactStruct&) = delete;
  CompactStruct& operator=(const CompactStruct&) = delete;

  void i32(int field, int32_t value) { head(field, i32_type), zigzag(value); }
  void i64(int field, uint64_t value) { head(field, i64_type), zigzag(static_cast<int64_t>(value)); }
  void text(int field, std::string_view value) { head(field, binary_type), bytes(value); }
  /// To be filled and destroyed before this goes on.
  CompactStruct inner(int field) {
    head(field, struct_type);
    return CompactStruct(out_);
  }
  void i32_list(int field, std::initializer_list<int32_t> values) {
    list(field, i32_type, values.size());
    for (const int32_t value : values) zigzag(value);
  }
  void text_list(int field, std::initializer_list<std::string_view> values) {
    list(field, binary_type, values.size());
    for (const std::string_view value : values) bytes(value);
  }
  /// Calls `fill(CompactStruct&, value)` for each.
  template <typename Values, typename Fill>
  void struct_list(int field, const Values& values, Fill&& fill) {
    list(field, struct_type, values.size());
    for (const auto& value : values) {
      CompactStruct one(out_);
      fill(one, value);
    }
  }

 private:
  void head(int field, Type type) {
    out_ += static_cast<char>((field - last_field_) << 4 | type);  // no struct here leaves out 15 fields
    last_field_ = field;
  }
  void list(int field, Type type, size_t size) {
    head(field, list_type);
    if (size < 15) {
      out_ += static_cast<char>(size << 4 | type);
    } else {
      out_ += static_cast<char>(0xF0 | type);
      varint(size);
    }
  }
  void bytes(std::string_view value) {
    varint(value.size());
    out_ += value;
  }
  void zigzag(int64_t value) {
    varint(static_cast<uint64_t>(value) << 1 ^ static_cast<uint64_t>(value >> 63));
  }
  void varint(uint64_t value) {
    for (; value >= 0x80; value >>= 7) out_ += static_cast<char>(value | 0x80);
    out_ += static_cast<char>(value);
  }

  std::string& out_;
  int last_field_ = 0;
};

using Note = std::pair<std::string, std::string>;

void put_notes(CompactStruct& owner, int field, const Notes& notes) {
  owner.struct_list(field, notes, [](CompactStruct& one, const Note& note) {
    one.text(1, note.first);
    one.text(2, note.second);
  });
}

/// Flags as PLAIN has them: eight in a byte, the first in its lowest bit.
std::vector<std::byte> packed_flags(std::span<const std::byte> flags) {
  std::vector<std::byte> packed((flags.size() + 7) / 8);
  for (size_t i = 0; i < flags.size(); ++i) packed[i / 8] |= flags[i] << (i % 8);
  return packed;
}

void put_page_header(std::string& out, size_t raw_bytes, size_t stored_bytes, size_t rows) {
  CompactStruct page(out);
  page.i32(1, data_page);
  page.i32(2, static_cast<int32_t>(raw_bytes));
  page.i32(3, static_cast<int32_t>(stored_bytes));
  CompactStruct data = page.inner(5);
  data.i32(1, static_cast<int32_t>(rows));
  data.i32(2, plain);
  data.i32(3, rle);  // of levels, which columns without missing values do not have
  data.i32(4, rle);
}

}  // namespace

ParquetFile::ParquetFile(const std::filesystem::path& path, std::vector<Column> columns, Notes notes,
                         std::string program)
    : file_(path), columns_(std::move(columns)), notes_(std::move(notes)), program_(std::move(program)) {
  compressor_ = ZSTD_createCCtx();
  if (compressor_ == nullptr) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(compressor_, ZSTD_c_compressionLevel, zstd_level);
  write(magic);
}

ParquetFile::~ParquetFile() { ZSTD_freeCCtx(compressor_); }

void ParquetFile::write(std::string_view bytes) {
  file_.write(bytes);
  written_bytes_ += bytes.size();
}

ParquetFile::Chunk ParquetFile::add_page(const Column& column, std::span<const std::byte> values,
                                         size_t rows) {
  std::vector<std::byte> packed;
  if (column.type == ColumnType::flag) values = packed = packed_flags(values);
  std::string stored(ZSTD_compressBound(values.size()), '\0');
  const size_t size = ZSTD_compress2(compressor_, stored.data(), stored.size(), values.data(), values.size());
  if (ZSTD_isError(size)) throw std::bad_alloc();  // its buffer is large enough: memory is all that it lacks
  stored.resize(size);
  std::string header;
  put_page_header(header, values.size(), size, rows);
  const Chunk chunk{written_bytes_, header.size() + values.size(), header.size() + size};
  write(header);
  write(stored);
  return chunk;
}

void ParquetFile::add(const ColumnBatch& rows) {
  if (rows.rows() == 0) return;
  RowGroup group{rows.rows(), {}};
  for (size_t i = 0; i < columns_.size(); ++i)
    group.chunks.push_back(add_page(columns_[i], rows.values(i), rows.rows()));
  rows_ += group.rows;
  groups_.push_back(std::move(group));
}

void ParquetFile::put_footer(std::string& out) const {
  CompactStruct footer(out);
  footer.i32(1, format_version);
  std::vector<const Column*> schema{nullptr};  // the root first
  for (const Column& column : columns_) schema.push_back(&column);
  footer.struct_list(2, schema, [&](CompactStruct& element, const Column* column) {
    if (column != nullptr) {
      element.i32(1, parquet_type(column->type));
      element.i32(3, required);
      element.text(4, column->name);
    } else {
      element.text(4, "schema");
      element.i32(5, static_cast<int32_t>(columns_.size()));
    }
  });
  footer.i64(3, rows_);
  footer.struct_list(4, groups_, [&](CompactStruct& written, const RowGroup& group) {
    uint64_t raw_bytes = 0, stored_bytes = 0;
    size_t next = 0;
    written.struct_list(1, group.chunks, [&](CompactStruct& place, const Chunk& chunk) {
      const Column& column = columns_[next++];
      raw_bytes += chunk.raw_bytes, stored_bytes += chunk.stored_bytes;
      place.i64(2, chunk.offset);
      CompactStruct about = place.inner(3);
      about.i32(1, parquet_type(column.type));
      about.i32_list(2, {plain});
      about.text_list(3, {column.name});
      about.i32(4, zstd_codec);
      about.i64(5, group.rows);
      about.i64(6, chunk.raw_bytes);
      about.i64(7, chunk.stored_bytes);
      put_notes(about, 8, {{"unit", std::string(column.unit)}, {"meaning", std::string(column.meaning)}});
      about.i64(9, chunk.offset);
    });
    written.i64(2, raw_bytes);
    written.i64(3, group.rows);
    written.i64(5, group.chunks.front().offset);
    written.i64(6, stored_bytes);
  });
  put_notes(footer, 5, notes_);
  footer.text(6, program_);
}

void ParquetFile::finish() {
  std::string about;
  put_footer(about);
  write(about);
  const auto size = static_cast<uint32_t>(about.size());
  for (int shift = 0; shift < 32; shift += 8) file_.write_value(static_cast<uint8_t>(size >> shift));
  write(magic);
  file_.commit();
}

}  // namespace ream::tables
