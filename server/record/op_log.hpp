#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "record/chunk.hpp"
#include "record/log_sink.hpp"
#include "record/ops.hpp"

namespace ream::record {

/// What a recording may hold beside its ticks; it may also follow when nobody writes ticks any more.
using Note = std::variant<ops::Event, ops::Annotation, ops::End>;

/// Writes an op log: a magic number and revision, then chunks. A chunk is one zstd frame of ops behind a
/// header with lengths, what it holds, a checksum of the stored bytes and one of the header itself; checksums
/// are chained, so that a chunk lost from the middle is noticed. Used by one thread; nothing is written
/// before close_chunk().
class OpLogWriter {
 public:
  /// A new log.
  explicit OpLogWriter(std::unique_ptr<LogSink> sink);
  /// One that goes on after what a reader found whole. `sink` has been cut to reader.whole_bytes().
  OpLogWriter(std::unique_ptr<LogSink> sink, uint64_t chain);

  /// Adds an op to the chunk that is being made. Rows of tick become one op, where the first of them stood.
  template <typename Op>
  void add(const Op& op) {
    if constexpr (std::is_same_v<Op, ops::Tick>) {
      rows_.push_back(op);
    } else {
      ops::put(rows_.empty() ? raw_ : after_rows_, op);
      if constexpr (std::is_same_v<Op, ops::Bricks>)
        place_.has_key = place_.has_key || op.key != 0;
      else if constexpr (!std::is_same_v<Op, ops::Checkpoint>)
        place_.has_notes = true;
    }
  }
  /// Compresses and appends the chunk; nothing when no op was added. Throws Error io; the log must then not
  /// be used any more, and the file is whole up to the chunk before.
  void close_chunk();
  void sync() { sink_->sync(); }
  uint64_t bytes_written() const { return bytes_written_; }

 private:
  std::unique_ptr<LogSink> sink_;
  Compressor compressor_;
  uint64_t chain_ = 0, bytes_written_ = 0;
  bool failed_ = false;
  ops::Bytes file_header_;  ///< until it has been written
  ops::Bytes raw_;          ///< ops added before the chunk's first tick
  std::vector<ops::Tick> rows_;
  ops::Bytes after_rows_;
  ChunkPlace place_;
};

/// Reads an op log of any revision from 2 on. Opening reads chunk headers only, some milliseconds for an
/// hour.
class OpLogReader {
 public:
  /// Error not_found, io; invalid_input when it is no recording, one of a newer revision, or not even its
  /// first chunk is whole.
  explicit OpLogReader(const std::filesystem::path& path);
  ~OpLogReader();
  OpLogReader(OpLogReader&&) noexcept;
  OpLogReader& operator=(OpLogReader&&) noexcept;

  /// For ops::read().
  uint32_t revision() const;
  const std::filesystem::path& path() const;
  /// Chunks whose headers are whole and whose bytes are all there, in the file's order.
  const std::vector<ChunkPlace>& chunks() const;
  /// Bytes of the file up to the end of the last of chunks().
  uint64_t whole_bytes() const;
  /// One sentence about what follows the last of chunks(); empty when nothing does.
  const std::string& damage() const;
  /// Value to continue writing with after the last of chunks(). Error conflict for an older revision, which
  /// is not continued.
  uint64_t chain() const;

  /// The ops of chunk `i`, decompressed, for ops::read(). Error invalid_input, naming file and time, when the
  /// bytes are not those that were written. Safe from several threads.
  ops::Bytes read_chunk(size_t i) const;
  /// Reads every chunk; the first that is damaged ends chunks(), whole_bytes() and damage() are then about
  /// that. Takes about a second a gigabyte.
  void check_all();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Appends one chunk of notes behind what `log` has found whole, fsynced; what is behind that in the file is
/// cut off. Error io when it cannot be written; the file is then as it was.
void append_notes(const OpLogReader& log, const std::vector<Note>& notes);

}  // namespace ream::record
