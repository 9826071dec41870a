#include "store/zip_archive.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <zip.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <set>

#include "core/error.hpp"
#include "core/file.hpp"

namespace ream::store {
namespace {

namespace fs = std::filesystem;

constexpr size_t piece_bytes = 1u << 20;
constexpr double progress_step = 0.002;
/// Longer and deeper than any folder of slices or sessions.
constexpr size_t max_name_bytes = 1024, max_name_parts = 16;

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct CloseEntry {
  void operator()(zip_file_t* entry) const { zip_fclose(entry); }
};
struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Told by libzip while it writes; no exception may pass through it.
struct Packing {
  const Progress& progress;
  std::exception_ptr refusal;

  static void report_progress(zip_t*, double share, void* state) noexcept {
    auto& self = *static_cast<Packing*>(state);
    try {
      if (!self.refusal) self.progress(share, "packing");
    } catch (...) {
      self.refusal = std::current_exception();
    }
  }
  static int cancelled(zip_t*, void* state) noexcept { return static_cast<Packing*>(state)->refusal ? 1 : 0; }
};

std::string message_of(int code) {
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  std::string words = zip_error_strerror(&error);
  zip_error_fini(&error);
  return words;
}

std::unique_ptr<zip_t, Discard> open_to_read(const fs::path& path) {
  std::error_code failed;
  if (!fs::is_regular_file(path, failed))
    throw Error(ErrorKind::not_found, "there is no file " + path.string());
  int code = 0;
  std::unique_ptr<zip_t, Discard> archive(zip_open(path.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, &code));
  if (!archive && code == ZIP_ER_OPEN)
    throw Error(ErrorKind::io, "cannot read " + path.string() + ": " + std::strerror(errno));
  if (!archive)
    throw Error(ErrorKind::invalid_input, path.string() + " is not a valid zip archive: " + message_of(code));
  return archive;
}

bool stays_inside(const std::string& name) {
  if (name.empty() || name.size() > max_name_bytes || name.find('\\') != std::string::npos ||
      name.find('\0') != std::string::npos)
    return false;
  const fs::path path(name);
  if (path.is_absolute()) return false;
  size_t parts = 0;
  for (const fs::path& part : path)
    if (part == ".." || part == "." || (!part.empty() && ++parts > max_name_parts)) return false;
  return true;
}

/// Folders that an entry needs and that were not there for the ones before it. Each costs as much as a file.
size_t new_folders(const std::string& name, std::set<std::string>& folders) {
  size_t made = 0;
  for (size_t slash = name.find('/'); slash != std::string::npos; slash = name.find('/', slash + 1))
    made += folders.insert(name.substr(0, slash)).second ? 1 : 0;
  return made;
}

void write_entry(zip_t* archive, const ArchiveEntry& entry, const fs::path& zip) {
  zip_source_t* source = zip_source_file(archive, entry.file.c_str(), 0, entry.bytes);
  const zip_int64_t index =
      source == nullptr ? -1 : zip_file_add(archive, entry.name.c_str(), source, ZIP_FL_ENC_UTF_8);
  if (index < 0) {
    if (source != nullptr) zip_source_free(source);
    throw Error(ErrorKind::io,
                "cannot put " + entry.file.string() + " into " + zip.string() + ": " + zip_strerror(archive));
  }
  const std::string kind = entry.file.extension();
  const bool packed = kind == ".zst" || kind == ".ream" || kind == ".png";
  zip_set_file_compression(archive, static_cast<zip_uint64_t>(index), packed ? ZIP_CM_STORE : ZIP_CM_DEFLATE,
                           0);
}

Error unusable(const fs::path& zip, const std::string& name, const std::string& why) {
  std::string shown = name.substr(0, 100);
  for (char& c : shown)
    if (static_cast<unsigned char>(c) < 0x20) c = '?';
  return {ErrorKind::invalid_input, zip.string() + ": '" + shown + "' in it " + why};
}

/// Looks at all that the archive says of itself; returns the names.
std::vector<std::string> checked_names(zip_t* archive, const fs::path& zip, const UnpackLimits& limits) {
  const auto count = static_cast<uint64_t>(zip_get_num_entries(archive, 0));
  if (count > limits.entries)
    throw Error(ErrorKind::invalid_input, zip.string() + " holds " + std::to_string(count) +
                                              " files, more than may be unpacked (" +
                                              std::to_string(limits.entries) + ")");
  std::vector<std::string> names;
  std::set<std::string> folders;
  uint64_t total = 0, places = 0;
  for (zip_uint64_t i = 0; i < count; ++i) {
    const char* given = zip_get_name(archive, i, 0);
    names.emplace_back(given == nullptr ? "" : given);
    const std::string& name = names.back();
    if (!stays_inside(name))
      throw unusable(zip, name,
                     "has a name that leads out of the archive or too deep, and may not be unpacked");
    places += new_folders(name, folders) + (name.back() == '/' ? 0 : 1);
    if (places > limits.entries)
      throw unusable(zip, name,
                     "is in one folder too many: more files and folders than may be unpacked (" +
                         std::to_string(limits.entries) + ")");
    zip_uint8_t system = 0;
    zip_uint32_t attributes = 0;
    zip_file_get_external_attributes(archive, i, 0, &system, &attributes);
    constexpr zip_uint32_t type_mask = 0170000, link_type = 0120000;
    if (system == ZIP_OPSYS_UNIX && ((attributes >> 16) & type_mask) == link_type)
      throw unusable(zip, name, "is a link, and may not be unpacked");
    zip_stat_t stated;
    zip_stat_init(&stated);
    if (zip_stat_index(archive, i, 0, &stated) != 0) throw unusable(zip, name, "cannot be read");
    if ((stated.valid & ZIP_STAT_ENCRYPTION_METHOD) != 0 && stated.encryption_method != ZIP_EM_NONE)
      throw unusable(zip, name, "is encrypted; make the archive without a password");
    const uint64_t size = (stated.valid & ZIP_STAT_SIZE) != 0 ? stated.size : 0;
    if (size > limits.bytes - total)
      throw unusable(zip, name,
                     "is larger than may be unpacked (" + std::to_string(limits.bytes >> 20) + " MB in all)");
    total += size;
  }
  return names;
}

/// Copies at most `limit` bytes out and returns how many there were.
uint64_t unpack_entry(zip_t* archive, zip_uint64_t index, const std::string& name, const fs::path& zip,
                      const fs::path& to, uint64_t limit) {
  std::unique_ptr<zip_file_t, CloseEntry> entry(zip_fopen_index(archive, index, 0));
  if (!entry) throw unusable(zip, name, std::string("cannot be read: ") + zip_strerror(archive));
  std::error_code failed;
  fs::create_directories(to.parent_path(), failed);
  std::unique_ptr<std::FILE, CloseFile> file(failed ? nullptr : std::fopen(to.c_str(), "wbx"));
  if (!file && (errno == EEXIST || errno == EISDIR || errno == ENOTDIR))
    throw unusable(zip, name, "has the name of another one");
  if (!file) throw Error(ErrorKind::io, "cannot write " + to.string());
  std::vector<char> piece(piece_bytes);
  uint64_t total = 0;
  for (;;) {
    const zip_int64_t got = zip_fread(entry.get(), piece.data(), piece.size());
    if (got < 0) throw unusable(zip, name, "is damaged");
    if (got == 0) break;
    total += static_cast<uint64_t>(got);
    if (total > limit) throw unusable(zip, name, "is larger than may be unpacked");
    if (std::fwrite(piece.data(), 1, static_cast<size_t>(got), file.get()) != static_cast<size_t>(got))
      throw Error(ErrorKind::io, "cannot write " + to.string());
  }
  if (std::fflush(file.get()) != 0) throw Error(ErrorKind::io, "cannot write " + to.string());
  return total;
}

void keep_time(zip_t* archive, zip_uint64_t index, const fs::path& file) {
  zip_stat_t stated;
  zip_stat_init(&stated);
  if (zip_stat_index(archive, index, 0, &stated) != 0 || (stated.valid & ZIP_STAT_MTIME) == 0) return;
  const timespec times[2] = {{0, UTIME_OMIT}, {stated.mtime, 0}};
  ::utimensat(AT_FDCWD, file.c_str(), times, 0);
}

}  // namespace

void write_zip(const fs::path& path, const std::vector<ArchiveEntry>& entries, const Progress& progress) {
  const fs::path temporary = path.string() + ".tmp";
  int code = 0;
  std::unique_ptr<zip_t, Discard> archive(zip_open(temporary.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code));
  if (!archive) throw Error(ErrorKind::io, "cannot write " + path.string() + ": " + message_of(code));
  for (const ArchiveEntry& entry : entries) write_entry(archive.get(), entry, path);
  Packing packing{progress, nullptr};
  zip_register_progress_callback_with_state(archive.get(), progress_step, &Packing::report_progress, nullptr,
                                            &packing);
  zip_register_cancel_callback_with_state(archive.get(), &Packing::cancelled, nullptr, &packing);
  if (zip_close(archive.get()) != 0) {
    if (packing.refusal) std::rethrow_exception(packing.refusal);
    throw Error(ErrorKind::io, "cannot write " + path.string() + ": " + zip_strerror(archive.get()));
  }
  static_cast<void>(archive.release());  // closing has freed it
  std::error_code failed, ignored;
  try {
    sync_file(temporary);
  } catch (const Error&) {
    failed = std::make_error_code(std::errc::io_error);
  }
  if (!failed) fs::rename(temporary, path, failed);
  if (failed) {
    fs::remove(temporary, ignored);
    throw Error(ErrorKind::io, "cannot write " + path.string());
  }
  sync_folder(path.parent_path());
}

std::vector<std::string> zip_names(const fs::path& path) {
  const auto archive = open_to_read(path);
  std::vector<std::string> names;
  for (zip_int64_t i = 0; i < zip_get_num_entries(archive.get(), 0); ++i)
    if (const char* name = zip_get_name(archive.get(), static_cast<zip_uint64_t>(i), 0); name != nullptr)
      names.emplace_back(name);
  return names;
}

void unpack_zip(const fs::path& path, const fs::path& folder, const UnpackLimits& limits,
                const Progress& progress) {
  const auto archive = open_to_read(path);
  const auto names = checked_names(archive.get(), path, limits);
  uint64_t room = limits.bytes;
  for (size_t i = 0; i < names.size(); ++i) {
    progress(static_cast<double>(i) / static_cast<double>(names.size()), "unpacking");
    if (names[i].back() == '/') continue;
    room -= unpack_entry(archive.get(), i, names[i], path, folder / names[i], room);
    if (limits.keep_times) keep_time(archive.get(), i, folder / names[i]);
  }
  if (limits.durable) sync_tree(folder);
}

}  // namespace ream::store
