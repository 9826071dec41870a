#include "reader/row_store.hpp"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>

#include "core/error.hpp"
#include "core/thread_pool.hpp"

namespace ream::reader {
namespace fs = std::filesystem;
namespace {

constexpr uint64_t block_bytes = 4 << 20;
constexpr uint64_t short_row_bytes = 16;  // to guess how many rows there can be
constexpr size_t readable_behind = 64;

}  // namespace

RowStore::RowStore(const fs::path& path, MemoryBudget& budget, const Progress& progress)
    : budget_(budget), path_(path), parsers_(threads) {
  if (!fs::is_regular_file(path)) throw Error(ErrorKind::not_found, "no such file: " + path.string());
  file_ = FileDescriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file_) throw Error(ErrorKind::io, "cannot read " + path.string() + ": " + std::strerror(errno));
  file_bytes_ = fs::file_size(path);
  blocks_.resize((file_bytes_ + block_bytes - 1) / block_bytes);
  if (!budget.fits(2 * file_bytes_ / short_row_bytes * sizeof(RowRecord)))
    spill_ = std::make_unique<SpillFile>(budget.folder());
  std::mutex mutex;
  std::optional<RowFault> first_fault;
  std::vector<bool> busy(threads);
  const auto work = [&](size_t block) {
    size_t parser = 0;
    {
      const std::lock_guard lock(mutex);
      if (first_fault && first_fault->byte < block * block_bytes) return;
      parser = busy[0] ? 1 : 0;
      busy[parser] = true;
    }
    std::vector<char> text;
    std::vector<RowRecord> rows;
    const char *begin = nullptr, *end = nullptr;
    uint64_t byte = 0;
    read_block(block, text, begin, end, byte);
    rows.reserve(text.size() / 40);
    const auto fault = parsers_[parser].parse(begin, end, byte, rows);
    blocks_[block].parser = parser;
    keep(block, std::move(rows));
    const std::lock_guard lock(mutex);
    busy[parser] = false;
    if (fault && (!first_fault || fault->byte < first_fault->byte)) first_fault = fault;
  };
  parallel_for(2, blocks_.size(), work, progress, "reading rows");
  if (first_fault)
    throw Error(ErrorKind::invalid_input, path_.string() + " line " +
                                              std::to_string(line_of_byte(first_fault->byte)) + ": " +
                                              first_fault->why);
  for (const Block& block : blocks_) size_ += block.count;
  if (!spill_) budget.take(size_ * sizeof(RowRecord), "reading " + path.string());
}

RowStore::~RowStore() {
  if (!spill_) budget_.give_back(size_ * sizeof(RowRecord));
}

/// The lines that begin in the block, the last of them whole.
void RowStore::read_block(size_t block, std::vector<char>& text, const char*& begin, const char*& end,
                          uint64_t& byte) const {
  const uint64_t first = block * block_bytes, from = first == 0 ? 0 : first - 1;
  const uint64_t to = std::min(file_bytes_, first + block_bytes + RowParser::max_line_bytes);
  text.resize(to - from + 1 + readable_behind);
  const ssize_t got = file_.read_at(from, std::as_writable_bytes(std::span(text).first(to - from)));
  if (got < 0 || static_cast<uint64_t>(got) < to - from)
    throw Error(ErrorKind::io,
                "cannot read " + path_.string() +
                    (got < 0 ? std::string(": ") + std::strerror(errno) : ", it was cut short"));
  const char* const all = text.data() + (to - from);
  text[to - from] = '\n';  // ends the last line, and any search
  begin = text.data();
  byte = from;
  if (first > 0) {
    begin = static_cast<const char*>(std::memchr(begin, '\n', static_cast<size_t>(all - begin) + 1)) + 1;
    byte += static_cast<uint64_t>(begin - text.data());
  }
  end = std::min(all, static_cast<const char*>(text.data()) + (first - from) + block_bytes);
  if (end == all) return;
  // The line that begins last must end in what was read.
  if (std::memchr(end, '\n', static_cast<size_t>(all - end)) == nullptr)
    throw Error(ErrorKind::invalid_input,
                path_.string() + " line " +
                    std::to_string(line_of_byte(from + static_cast<uint64_t>(end - text.data()))) +
                    ": is too long for 'x y z gray'");
}

void RowStore::keep(size_t block, std::vector<RowRecord>&& rows) {
  blocks_[block].count = rows.size();
  if (!spill_) {
    rows.shrink_to_fit();
    blocks_[block].rows = std::move(rows);
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    blocks_[block].first_row = spilled_;
    spilled_ += rows.size();
  }
  spill_->write_at(blocks_[block].first_row * sizeof(RowRecord), std::as_bytes(std::span(rows)));
}

std::span<const RowRecord> RowStore::rows(size_t block, std::vector<RowRecord>& scratch) const {
  const Block& b = blocks_[block];
  if (!spill_) return b.rows;
  scratch.resize(b.count);
  spill_->read_at(b.first_row * sizeof(RowRecord), std::as_writable_bytes(std::span(scratch)));
  return scratch;
}

uint64_t RowStore::line_of_byte(uint64_t byte) const {
  uint64_t line = 1;
  std::vector<char> text(std::min(block_bytes, byte));
  for (uint64_t at = 0; at < byte;) {
    const ssize_t n = file_.read_at(
        at, std::as_writable_bytes(std::span(text).first(std::min<uint64_t>(text.size(), byte - at))));
    if (n <= 0) break;
    line += static_cast<uint64_t>(std::count(text.begin(), text.begin() + n, '\n'));
    at += static_cast<uint64_t>(n);
  }
  return line;
}

uint64_t RowStore::line_of_row(size_t block, size_t row) const {
  std::vector<char> text;
  const char *begin = nullptr, *end = nullptr;
  uint64_t byte = 0;
  read_block(block, text, begin, end, byte);
  RowParser parser;
  std::vector<RowRecord> rows;
  std::vector<uint64_t> bytes;
  parser.parse(begin, end, byte, rows, &bytes);
  return line_of_byte(bytes.at(row));
}

}  // namespace ream::reader
