#include <fstream>
#include <utility>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "record/chunk.hpp"
#include "record/op_log.hpp"

namespace ream::record {
namespace {

namespace fs = std::filesystem;

/// Bytes of the file from there on.
std::vector<std::byte> tail_of(const fs::path& path, uint64_t from) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) throw Error(ErrorKind::io, "cannot read " + path.string());
  std::vector<std::byte> tail(static_cast<size_t>(in.tellg()) - from);
  in.seekg(static_cast<std::streamoff>(from));
  in.read(reinterpret_cast<char*>(tail.data()), static_cast<std::streamsize>(tail.size()));
  if (!in) throw Error(ErrorKind::io, "cannot read " + path.string());
  return tail;
}

}  // namespace

OpLogWriter::OpLogWriter(std::unique_ptr<LogSink> sink) : sink_(std::move(sink)) {
  file_header_ = file_header(ops::newest_revision, chain_);
}

OpLogWriter::OpLogWriter(std::unique_ptr<LogSink> sink, uint64_t chain)
    : sink_(std::move(sink)), chain_(chain) {}

void OpLogWriter::close_chunk() {
  if (failed_)
    throw Error(ErrorKind::io, "the recording is not written any more, because writing it failed before");
  if (!rows_.empty()) {
    place_.first_tick = rows_.front().tick;
    place_.ticks = static_cast<uint32_t>(rows_.size());
    ops::put_rows(raw_, rows_);
    raw_.insert(raw_.end(), after_rows_.begin(), after_rows_.end());
  }
  if (raw_.empty()) return;
  failed_ = true;  // until all has gone well
  if (raw_.size() > max_raw_bytes)
    throw Error(ErrorKind::invalid_input, "a quarter of a second of the recording is larger than 256 MiB");
  const ops::Bytes stored = compressor_.compress(raw_);
  place_.raw_bytes = static_cast<uint32_t>(raw_.size());
  place_.stored_bytes = static_cast<uint32_t>(stored.size());
  ChunkHeader header{place_, hash_bytes(stored), chain_};
  ops::Bytes out = std::exchange(file_header_, {});
  put_chunk_header(out, header);
  out.insert(out.end(), stored.begin(), stored.end());
  sink_->append(out);
  bytes_written_ += out.size();
  chain_ = header.chain;
  raw_.clear();
  rows_.clear();
  after_rows_.clear();
  place_ = {};
  failed_ = false;
}

void append_notes(const OpLogReader& log, const std::vector<Note>& notes) {
  const std::vector<std::byte> tail = tail_of(log.path(), log.whole_bytes());
  try {
    OpLogWriter writer(continue_log_file(log.path(), log.whole_bytes()), log.chain());
    for (const Note& note : notes) std::visit([&](const auto& op) { writer.add(op); }, note);
    writer.close_chunk();
    writer.sync();
  } catch (const Error&) {
    continue_log_file(log.path(), log.whole_bytes())->append(tail);
    throw;
  }
}

}  // namespace ream::record
