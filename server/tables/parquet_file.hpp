#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "tables/column_batch.hpp"

struct ZSTD_CCtx_s;

namespace ream::tables {

/// Words by name, in the order in which they are written.
using Notes = std::vector<std::pair<std::string, std::string>>;

/// A table as an Apache Parquet file (format 2, https://parquet.apache.org/docs/file-format/): values PLAIN,
/// none missing, one page for each column of a row group, compressed by zstd. Unit and meaning of each column
/// are key-value metadata of its chunks. Written to a temporary name and renamed by finish(); the same rows
/// make the same bytes.
class ParquetFile {
 public:
  /// `notes`: the file's key-value metadata. `program`: "ream version 1.2.3". Throws Error io.
  ParquetFile(const std::filesystem::path& path, std::vector<Column> columns, Notes notes,
              std::string program);
  ~ParquetFile();
  ParquetFile(const ParquetFile&) = delete;
  ParquetFile& operator=(const ParquetFile&) = delete;

  /// One row group, of the columns that the file has, at most 128 MB; nothing for no rows. Throws Error io.
  void add(const ColumnBatch& rows);
  /// Writes the footer and gives the file its name. Throws Error io.
  void finish();

 private:
  /// A column of a row group in the file.
  struct Chunk {
    uint64_t offset, raw_bytes, stored_bytes;  ///< header of the page and page
  };
  struct RowGroup {
    uint64_t rows;
    std::vector<Chunk> chunks;
  };

  void write(std::string_view bytes);
  Chunk add_page(const Column& column, std::span<const std::byte> values, size_t rows);
  void put_footer(std::string& out) const;

  AtomicFile file_;
  const std::vector<Column> columns_;
  const Notes notes_;
  const std::string program_;
  ZSTD_CCtx_s* compressor_;
  uint64_t written_bytes_ = 0, rows_ = 0;
  std::vector<RowGroup> groups_;
};

}  // namespace ream::tables
