#include "app/data_snapshot.hpp"

#include <sys/stat.h>

#include <algorithm>

#include "app/restore_backup.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "session/folder/session_folder.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

constexpr int max_attempts = 5;

bool passing(const std::string& name) {
  return name.front() == '.' || name.ends_with(".tmp") || name == "lock";
}

/// A file as it is now: its number changes when it is replaced.
struct Seen {
  std::string name;  ///< with the folders below the one that was looked at
  ino_t number = 0;
  int64_t bytes = 0;

  /// A recording may grow.
  bool operator==(const Seen& other) const { return name == other.name && number == other.number; }
};

/// All files below `folder`, sorted; none when it has gone.
std::vector<Seen> look(const fs::path& folder) {
  std::vector<Seen> found;
  std::error_code failed;
  for (fs::recursive_directory_iterator next(folder, failed), end; !failed && next != end;
       next.increment(failed)) {
    const std::string name = next->path().filename().string();
    if (passing(name) || name.find('\\') != std::string::npos) {
      next.disable_recursion_pending();
      continue;
    }
    struct stat about {};
    if (::lstat(next->path().c_str(), &about) == 0 && S_ISREG(about.st_mode))
      found.push_back({next->path().lexically_relative(folder).string(), about.st_ino, about.st_size});
  }
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
  std::error_code failed, ignored;
  for (fs::directory_iterator next(data, failed), end; !failed && next != end; next.increment(failed)) {
    const std::string name = next->path().filename().string();
    if (!passing(name) && name != "uploads" && !name.starts_with(moved_aside) && next->is_directory(ignored))
      names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

DataSnapshot snapshot_data(const fs::path& data, const fs::path& into) {
  DataSnapshot snapshot;
  for (const std::string& kept : kept_folders(data)) {
    std::error_code failed;
    for (fs::directory_iterator next(data / kept, failed), end; !failed && next != end;
         next.increment(failed)) {
      const std::string name = next->path().filename().string();
      if (passing(name)) continue;
      const std::string place = kept + "/" + name;
      const bool folder = next->is_directory();
      const bool live = kept == "sessions" && is_live(next->path());
      if (folder) {
        const std::vector<Seen> files = hold_all(next->path(), into / place);
        for (const Seen& file : files)
          snapshot.files.push_back({into / place / file.name, place + "/" + file.name, file.bytes});
        if (files.empty()) continue;
      } else if (next->is_regular_file() && hold(next->path(), into / place)) {
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
