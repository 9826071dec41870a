#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "core/error.hpp"
#include "core/file_descriptor.hpp"
#include "core/hash.hpp"
#include "record/chunk.hpp"
#include "record/op_log.hpp"

namespace ream::record {
namespace {

/// An open file; reads at any place, from any thread.
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path)
      : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (!file_ && errno == ENOENT) throw Error(ErrorKind::not_found, "no such file: " + path.string());
    struct stat status {};
    if (!file_ || ::fstat(file_.get(), &status) != 0) fail();
    if (!S_ISREG(status.st_mode))
      throw Error(ErrorKind::invalid_input, path.string() + " is no file; a recording.ream is expected");
    size_ = static_cast<uint64_t>(status.st_size);
  }

  const std::filesystem::path& path() const { return path_; }
  uint64_t size() const { return size_; }

  /// Fewer bytes than asked for only at the file's end.
  ops::Bytes read(uint64_t at, size_t count) const {
    ops::Bytes bytes(at >= size_ ? 0 : std::min<uint64_t>(count, size_ - at));
    const ssize_t got = file_.read_at(at, std::as_writable_bytes(std::span(bytes)));
    if (got < 0) fail();
    bytes.resize(static_cast<size_t>(got));
    return bytes;
  }

 private:
  [[noreturn]] void fail() const {
    throw Error(ErrorKind::io, "cannot read " + path_.string() + ": " + std::strerror(errno));
  }

  const std::filesystem::path path_;
  const FileDescriptor file_;
  uint64_t size_ = 0;
};

/// What reading a chunk needs beside its place.
struct Stored {
  uint64_t at = 0, checksum = 0, chain = 0;
};

std::string seconds(uint32_t ticks) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f s", ticks / 1000.0);
  return text;
}

}  // namespace

struct OpLogReader::Impl {
  explicit Impl(const std::filesystem::path& path) : file(path) {}

  InputFile file;
  uint32_t revision = 0;
  std::vector<ChunkPlace> places;
  std::vector<Stored> stored;
  std::string damage;

  void open();
  void find_chunks(uint64_t chain);
  ops::Bytes read_chunk(size_t i) const;
  /// Ticks that whole chunks before chunk `i` reach to.
  uint32_t ticks_before(size_t i) const;
  uint64_t end() const {
    return places.empty() ? file_header_bytes : stored.back().at + places.back().stored_bytes;
  }
  std::string path() const { return file.path().string(); }
  std::string since(size_t i, uint64_t at) const {
    return seconds(ticks_before(i)) + " into the session (byte " + std::to_string(at) + " of the file)";
  }
};

uint32_t OpLogReader::Impl::ticks_before(size_t i) const {
  while (i-- > 0)
    if (places[i].ticks > 0) return places[i].first_tick + places[i].ticks;
  return 0;
}

void OpLogReader::Impl::find_chunks(uint64_t chain) {
  uint64_t at = file_header_bytes;
  while (at < file.size()) {
    const auto bytes = file.read(at, chunk_header_bytes);
    const auto header = take_chunk_header(bytes, chain);
    const uint64_t stored_at = at + chunk_header_bytes;
    if (bytes.size() < chunk_header_bytes ||
        (header && header->place.stored_bytes > file.size() - stored_at)) {
      damage = path() + " ends inside a chunk, " + since(places.size(), at) + "; what comes before is whole";
      return;
    }
    if (!header) {
      damage = path() + " is damaged " + since(places.size(), at) +
               ": what is there does not continue it; what comes before is used";
      return;
    }
    places.push_back(header->place);
    places.back().offset = at;
    stored.push_back({stored_at, header->stored_checksum, header->chain});
    chain = header->chain;
    at = stored_at + header->place.stored_bytes;
  }
}

void OpLogReader::Impl::open() {
  const auto header = take_file_header(file.read(0, file_header_bytes));
  if (!header) throw Error(ErrorKind::invalid_input, path() + " is not a recording of this program");
  revision = header->revision;
  if (revision > ops::newest_revision)
    throw Error(ErrorKind::invalid_input, path() + " is a recording of revision " + std::to_string(revision) +
                                              "; this program reads up to " +
                                              std::to_string(ops::newest_revision) + ", use a newer one");
  find_chunks(header->chain);
  if (places.empty())
    throw Error(ErrorKind::invalid_input, path() + " is damaged or ends before anything was recorded");
  read_chunk(0);
}

ops::Bytes OpLogReader::Impl::read_chunk(size_t i) const {
  const ChunkPlace& place = places.at(i);
  const auto bytes = file.read(stored[i].at, place.stored_bytes);
  std::optional<ops::Bytes> raw;
  if (bytes.size() == place.stored_bytes && hash_bytes(bytes) == stored[i].checksum)
    raw = decompressed(bytes, place.raw_bytes);
  if (!raw)
    throw Error(ErrorKind::invalid_input, path() + " is damaged " + since(i, place.offset) +
                                              ": a chunk's checksum does not fit; what comes before is used");
  return *std::move(raw);
}

OpLogReader::OpLogReader(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {
  impl_->open();
}
OpLogReader::~OpLogReader() = default;
OpLogReader::OpLogReader(OpLogReader&&) noexcept = default;
OpLogReader& OpLogReader::operator=(OpLogReader&&) noexcept = default;

uint32_t OpLogReader::revision() const { return impl_->revision; }
const std::filesystem::path& OpLogReader::path() const { return impl_->file.path(); }
const std::vector<ChunkPlace>& OpLogReader::chunks() const { return impl_->places; }
uint64_t OpLogReader::whole_bytes() const { return impl_->end(); }
const std::string& OpLogReader::damage() const { return impl_->damage; }
ops::Bytes OpLogReader::read_chunk(size_t i) const { return impl_->read_chunk(i); }

uint64_t OpLogReader::chain() const {
  if (revision() != ops::newest_revision)
    throw Error(ErrorKind::conflict, impl_->path() + " is of revision " + std::to_string(revision()) +
                                         "; only recordings of revision " +
                                         std::to_string(ops::newest_revision) + " can be gone on with");
  return impl_->stored.back().chain;
}

void OpLogReader::check_all() {
  for (size_t i = 0; i < impl_->places.size(); ++i) {
    try {
      impl_->read_chunk(i);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::invalid_input || i == 0) throw;
      impl_->damage = error.what();
      impl_->places.resize(i);
      impl_->stored.resize(i);
    }
  }
}

}  // namespace ream::record
