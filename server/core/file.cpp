#include "core/file.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <zstd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/file_descriptor.hpp"
#include "core/json.hpp"

namespace ream {
namespace fs = std::filesystem;
namespace {

std::string reason() { return std::strerror(errno); }

constexpr int compression_level = 1;
constexpr uintmax_t max_json_file_bytes = 64 << 20;

}  // namespace

std::string read_text_file(const fs::path& path) {
  const auto bytes = read_binary_file(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::vector<std::byte> read_binary_file(const fs::path& path) {
  std::error_code failed;
  if (!fs::exists(path, failed)) throw Error(ErrorKind::not_found, "no such file: " + path.string());
  if (fs::is_directory(path, failed))
    throw Error(ErrorKind::invalid_input, path.string() + " is a folder, a file is expected");
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) throw Error(ErrorKind::io, "cannot read " + path.string() + ": " + reason());
  std::vector<std::byte> bytes(static_cast<size_t>(in.tellg()));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!in) throw Error(ErrorKind::io, "cannot read " + path.string() + ": " + reason());
  return bytes;
}

void sync_folder(const fs::path& folder) {
  const FileDescriptor opened(
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!opened && errno == EACCES) return;  // names can be made in it, but it cannot be opened
  if ((!opened || ::fsync(opened.get()) != 0) && errno != EINVAL && errno != ENOTSUP)
    throw Error(ErrorKind::io, "cannot sync folder " + folder.string() + ": " + reason());
}

void sync_file(const fs::path& file) {
  const FileDescriptor opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (!opened || ::fsync(opened.get()) != 0)
    throw Error(ErrorKind::io, "cannot write " + file.string() + ": " + reason());
}

void sync_tree(const fs::path& folder) {
  std::error_code failed;
  for (fs::recursive_directory_iterator next(folder, failed), end; !failed && next != end;
       next.increment(failed)) {
    const fs::file_type type = next->symlink_status(failed).type();
    if (failed) break;
    if (type == fs::file_type::regular || type == fs::file_type::directory) sync_file(next->path());
  }
  if (failed) throw Error(ErrorKind::io, "cannot read " + folder.string() + ": " + failed.message());
  sync_file(folder);
}

void write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  AtomicFile file(path);
  file.write_at(0, bytes);
  file.commit();
}

void write_file_atomically(const fs::path& path, std::string_view text) {
  write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

void write_json_file(const fs::path& path, const nlohmann::json& json) {
  write_file_atomically(path, json.dump(2) + "\n");
}

nlohmann::json read_json_file(const fs::path& path) {
  std::error_code unknown;
  if (const uintmax_t size = fs::file_size(path, unknown); !unknown && size > max_json_file_bytes)
    throw Error(ErrorKind::invalid_input, path.string() + " is larger than " +
                                              std::to_string(max_json_file_bytes >> 20) +
                                              " MB: no JSON file of this program is");
  const std::string text = read_text_file(path);
  try {
    return parse_json(text);
  } catch (const Error& e) {
    throw Error(e.kind(), path.string() + " " + e.what());
  }
}

void make_writable_folder(const fs::path& path) {
  std::error_code failed;
  std::vector<fs::path> parents;  // of what is made
  for (fs::path made = path; !made.empty() && !fs::exists(made, failed); made = made.parent_path())
    parents.push_back(made.parent_path());
  fs::create_directories(path, failed);
  if (failed) throw Error(ErrorKind::io, "cannot create folder " + path.string() + ": " + failed.message());
  const fs::path probe = path / ("probe." + std::to_string(::getpid()) + ".tmp");
  const int fd = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) throw Error(ErrorKind::io, "cannot write in folder " + path.string() + ": " + reason());
  ::close(fd);
  ::unlink(probe.c_str());
  for (const fs::path& parent : parents) sync_folder(parent);
}

void read_zstd_file(const fs::path& path, std::span<std::byte> raw, const char* description) {
  const auto packed = read_binary_file(path);
  const unsigned long long size = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN)
    throw Error(ErrorKind::invalid_input, path.string() + " is not zstd data; import the case again");
  if (size != raw.size())
    throw Error(ErrorKind::invalid_input, path.string() + " holds " + std::to_string(size) + " bytes, " +
                                              description + " says " + std::to_string(raw.size()) +
                                              "; import the case again");
  const size_t read = ZSTD_decompress(raw.data(), raw.size(), packed.data(), packed.size());
  if (ZSTD_isError(read) || read != raw.size())
    throw Error(ErrorKind::invalid_input, path.string() + " is damaged or cut short; import the case again");
}

void write_zstd_file(const fs::path& path, std::span<const std::byte> raw) {
  std::vector<std::byte> packed(ZSTD_compressBound(raw.size()));
  const size_t size = ZSTD_compress(packed.data(), packed.size(), raw.data(), raw.size(), compression_level);
  if (ZSTD_isError(size))
    throw Error(ErrorKind::io, "cannot compress " + path.string() + ": " + ZSTD_getErrorName(size));
  write_file_atomically(path, std::span<const std::byte>(packed.data(), size));
}

}  // namespace ream
