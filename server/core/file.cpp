#include "core/file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/replaceable.hpp"

namespace ream {
namespace fs = std::filesystem;
namespace {

std::string reason() { return std::strerror(errno); }

void write_all(int fd, const std::byte* data, size_t size, const fs::path& path) {
  while (size > 0) {
    const ssize_t n = ::write(fd, data, size);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw Error(ErrorKind::io, "cannot write " + path.string() + ": " + reason());
    data += n;
    size -= static_cast<size_t>(n);
  }
}

fs::path temporary_beside(const fs::path& path) {
  fs::path name = path;
  name += "." + std::to_string(::getpid()) + ".tmp";
  return name;
}

/// The same folder as a name that a sibling can be put beside ("a/b/" -> "/here/a/b", "." -> "/here").
fs::path without_trailing_slash(const fs::path& path) {
  const fs::path normal = fs::absolute(path).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

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
  const int fd = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY);
  if (fd < 0) return;
  ::fsync(fd);
  ::close(fd);
}

void write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  require_replaceable(path);
  const fs::path temporary = temporary_beside(path);
  const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) throw Error(ErrorKind::io, "cannot write " + path.string() + ": " + reason());
  try {
    write_all(fd, bytes.data(), bytes.size(), path);
    if (::fsync(fd) != 0) throw Error(ErrorKind::io, "cannot write " + path.string() + ": " + reason());
  } catch (...) {
    ::close(fd);
    ::unlink(temporary.c_str());
    throw;
  }
  ::close(fd);
  if (::rename(temporary.c_str(), path.c_str()) != 0) {
    const std::string why = reason();
    ::unlink(temporary.c_str());
    throw Error(ErrorKind::io, "cannot write " + path.string() + ": " + why);
  }
  sync_folder(path.parent_path());
}

void write_file_atomically(const fs::path& path, std::string_view text) {
  write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

nlohmann::json read_json_file(const fs::path& path) {
  const std::string text = read_text_file(path);
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& e) {
    std::string what = e.what();
    const auto bracket = what.find("] ");
    if (bracket != std::string::npos) what = what.substr(bracket + 2);
    throw Error(ErrorKind::invalid_input, path.string() + " is not valid JSON: " + what);
  }
}

void make_writable_folder(const fs::path& path) {
  std::error_code failed;
  fs::create_directories(path, failed);
  if (failed) throw Error(ErrorKind::io, "cannot create folder " + path.string() + ": " + failed.message());
  const fs::path probe = temporary_beside(path / "probe");
  const int fd = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) throw Error(ErrorKind::io, "cannot write in folder " + path.string() + ": " + reason());
  ::close(fd);
  ::unlink(probe.c_str());
  sync_folder(path.parent_path());
}

FolderInProgress::FolderInProgress(fs::path final_path, bool replace)
    : final_(without_trailing_slash(final_path)), temporary_(temporary_beside(final_)) {
  std::error_code failed;
  if (fs::exists(final_, failed)) {
    if (!fs::is_directory(final_, failed))
      throw Error(ErrorKind::conflict, final_.string() + " exists and is not a folder; choose another place");
    if (!replace && !fs::is_empty(final_, failed))
      throw Error(ErrorKind::conflict, final_.string() + " exists and is not empty; choose another place");
  }
  fs::remove_all(temporary_, failed);
  for (fs::path p = final_.parent_path(); !fs::exists(p, failed) && p.has_relative_path();
       p = p.parent_path())
    made_parents_.push_back(p);
  make_writable_folder(temporary_);
}

FolderInProgress::~FolderInProgress() {
  std::error_code ignored;
  if (committed_) return;
  fs::remove_all(temporary_, ignored);
  for (const fs::path& parent : made_parents_) fs::remove(parent, ignored);  // unless others use it by now
}

void FolderInProgress::commit() {
  const auto check = [&](const std::error_code& failed) {
    if (failed)
      throw Error(ErrorKind::io, "cannot write folder " + final_.string() + ": " + failed.message());
  };
  std::error_code failed, ignored;
  fs::path old = final_;
  old += "." + std::to_string(::getpid()) + ".old.tmp";
  const bool had_old = fs::exists(final_, ignored);
  if (had_old) {
    fs::remove_all(old, ignored);
    fs::rename(final_, old, failed);
    check(failed);
  }
  fs::rename(temporary_, final_, failed);
  if (failed && had_old) fs::rename(old, final_, ignored);
  check(failed);
  committed_ = true;
  if (had_old) fs::remove_all(old, ignored);
  sync_folder(final_.parent_path());
}

}  // namespace ream
