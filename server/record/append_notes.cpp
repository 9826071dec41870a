#include "record/append_notes.hpp"

#include <fstream>

#include "core/error.hpp"

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
