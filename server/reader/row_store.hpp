#pragma once
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/file_descriptor.hpp"
#include "core/memory_budget.hpp"
#include "core/progress.hpp"
#include "reader/row_parser.hpp"

namespace ream::reader {

/// All rows `x y z gray` of a text file, read once on two threads, in its order: 12 bytes a row, in memory or
/// on the disk, as the budget has room.
class RowStore {
 public:
  /// Throws Error not_found, io, cancelled, or invalid_input naming the first line that is no row.
  RowStore(const std::filesystem::path& path, MemoryBudget& budget, const Progress& progress);
  ~RowStore();
  RowStore(const RowStore&) = delete;
  RowStore& operator=(const RowStore&) = delete;

  uint64_t size() const { return size_; }
  const RowParser& parser(size_t thread) const { return parsers_[thread]; }
  static constexpr size_t threads = 2;

  /// The file lies here in blocks, each read by one of the parsers.
  size_t blocks() const { return blocks_.size(); }
  size_t parser_of(size_t block) const { return blocks_[block].parser; }
  /// Valid until `scratch` changes. Thread-safe.
  std::span<const RowRecord> rows(size_t block, std::vector<RowRecord>& scratch) const;

  /// The line of a place in the file, and of a row of a block; read again.
  uint64_t line_of_byte(uint64_t byte) const;
  uint64_t line_of_row(size_t block, size_t row) const;

 private:
  struct Block {
    size_t parser = 0;
    uint64_t first_row = 0;  ///< in the order of keeping, of those on the disk
    size_t count = 0;
    std::vector<RowRecord> rows;
  };
  void read_block(size_t block, std::vector<char>& text, const char*& begin, const char*& end,
                  uint64_t& byte) const;
  void keep(size_t block, std::vector<RowRecord>&& rows);

  MemoryBudget& budget_;
  std::filesystem::path path_;
  FileDescriptor file_;
  uint64_t file_bytes_ = 0, size_ = 0;
  std::vector<RowParser> parsers_;
  std::vector<Block> blocks_;
  std::unique_ptr<SpillFile> spill_;
  uint64_t spilled_ = 0;
  std::mutex mutex_;
};

}  // namespace ream::reader
