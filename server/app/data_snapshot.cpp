#include "app/data_snapshot.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>

#include "app/restore_backup.hpp"
#include "core/error.hpp"
#include "core/folder_listing.hpp"
#include "core/log.hpp"
#include "session/folder/session_folder.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

constexpr int max_attempts = 5;

/// What is no part of the data; file systems put lost+found where they are mounted.
bool passing(const std::string& name) {
  return name.front() == '.' || name.ends_with(".tmp") || name == "lock" || name == "lost+found";
}

Error cannot_look_at(const fs::path& path, int why) {
  return {ErrorKind::io, "cannot look at " + path.string() + ": " + std::strerror(why)};
}

/// What is at the path, links followed; nothing where it has gone.
std::optional<struct stat> status_of(const fs::path& path) {
  struct stat about {};
  if (::stat(path.c_str(), &about) == 0) return about;
  const int why = errno;
  std::error_code failed;
  if (why == ENOENT && !fs::is_symlink(fs::symlink_status(path, failed))) return std::nullopt;
  throw cannot_look_at(path, why);
}

/// A file as it is now: its number changes when it is replaced.
struct Seen {
  std::string name;  ///< with the folders below the one that was looked at
  ino_t number = 0;
  int64_t bytes = 0;

  /// A recording may grow.
  bool operator==(const Seen& other) const { return name == other.name && number == other.number; }
};

void look_in(const fs::path& folder, const std::string& place, std::vector<Seen>& found) {
  for (const fs::path& path : paths_in(folder)) {
    const std::string name = path.filename().string();
    if (passing(name) || name.find('\\') != std::string::npos) continue;
    struct stat about {};
    if (::lstat(path.c_str(), &about) != 0) {
      if (errno == ENOENT) continue;
      throw cannot_look_at(path, errno);
    }
    if (S_ISREG(about.st_mode)) found.push_back({place + name, about.st_ino, about.st_size});
    if (S_ISDIR(about.st_mode)) look_in(path, place + name + "/", found);
  }
}

/// All files below `folder`, sorted; none when it has gone.
std::vector<Seen> look(const fs::path& folder) {
  std::vector<Seen> found;
  look_in(folder, "", found);
  std::sort(found.begin(), found.end(), [](const Seen& a, const Seen& b) { return a.name < b.name; });
  return found;
}

/// False when the file has gone meanwhile.
bool hold(const fs::path& file, const fs::path& to) {
  std::error_code failed;
  fs::create_directories(to.parent_path(), failed);
  fs::create_hard_link(file, to, failed);
  if (failed && fs::exists(file)) fs::copy_file(file, to, fs::copy_options::overwrite_existing, failed);
  if (!failed) return true;
  if (!fs::exists(file)) return false;
  throw Error(ErrorKind::io, "cannot keep " + file.string() + " as it is: " + failed.message());
}

/// All files of one session or case. None when it has gone.
std::vector<Seen> hold_all(const fs::path& folder, const fs::path& to) {
  std::vector<Seen> files = look(folder);
  for (int attempt = 0; attempt < max_attempts; ++attempt) {
    std::error_code ignored;
    fs::remove_all(to, ignored);
    const bool held = std::all_of(files.begin(), files.end(),
                                  [&](const Seen& file) { return hold(folder / file.name, to / file.name); });
    std::vector<Seen> now = look(folder);
    if (held && now == files) return files;
    files = std::move(now);
  }
  log::warn(folder.string() + " is being changed all the time; what is kept of it may not fit together");
  files = look(to);
  return files;
}

bool is_live(const fs::path& session_folder) {
  try {
    const auto found = session::read_session_folder(session_folder);
    return !found.lasting && is_live(found.status.state);
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

std::vector<std::string> kept_folders(const fs::path& data) {
  std::vector<std::string> names;
  for (const fs::path& path : paths_in(data)) {
    const std::string name = path.filename().string();
    if (passing(name) || name == "uploads" || name.starts_with(moved_aside)) continue;
    if (const auto status = status_of(path); status && S_ISDIR(status->st_mode)) names.push_back(name);
  }
  return names;
}

DataSnapshot snapshot_data(const fs::path& data, const fs::path& into) {
  DataSnapshot snapshot;
  for (const std::string& kept : kept_folders(data)) {
    for (const fs::path& path : paths_in(data / kept)) {
      const std::string name = path.filename().string();
      if (passing(name)) continue;
      const std::string place = kept + "/" + name;
      const auto status = status_of(path);
      if (!status) continue;
      const bool live = kept == "sessions" && is_live(path);
      if (S_ISDIR(status->st_mode)) {
        const std::vector<Seen> files = hold_all(path, into / place);
        for (const Seen& file : files)
          snapshot.files.push_back({into / place / file.name, place + "/" + file.name, file.bytes});
        if (files.empty()) continue;
      } else if (S_ISREG(status->st_mode) && hold(path, into / place)) {
        snapshot.files.push_back({into / place, place});
      } else {
        continue;
      }
      ++snapshot.counts[kept];
      if (live) snapshot.live.push_back(name);
    }
  }
  return snapshot;
}

}  // namespace ream::app
