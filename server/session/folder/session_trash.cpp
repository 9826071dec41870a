#include "session/folder/session_trash.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/folder_listing.hpp"
#include "core/log.hpp"
#include "core/new_id.hpp"
#include "core/text.hpp"
#include "core/utc.hpp"

namespace ream::session {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

/// Beside what lies here, under names that no session has.
constexpr const char* being_erased = ".erased-";

fs::path note_of(const fs::path& folder) { return folder / "deleted.json"; }

bool is_folder(const fs::path& folder) {
  std::error_code failed;
  return fs::is_directory(folder, failed);
}

void move_folder(const fs::path& from, const fs::path& to) {
  std::error_code failed;
  fs::rename(from, to, failed);
  if (failed)
    throw Error(ErrorKind::io,
                "cannot move " + from.string() + " to " + to.string() + ": " + failed.message());
  sync_folder(to.parent_path());
  sync_folder(from.parent_path());
}

/// As it was noted, else when the folder was moved.
std::string deleted_utc_of(const fs::path& folder) {
  try {
    return ream::utc_text(utc_moment(read_json_file(note_of(folder)).at("deleted_utc").get<std::string>()));
  } catch (const std::exception&) {
    struct stat about {};
    return utc_text(::stat(folder.c_str(), &about) == 0 ? about.st_ctime : std::time(nullptr));
  }
}

DeletedSession deleted_in(const fs::path& folder) {
  DeletedSession found{folder.filename().string(), deleted_utc_of(folder), std::nullopt};
  try {
    found.record = read_session_folder(folder);
  } catch (const Error& damage) {
    log::warn("deleted session " + found.id + " cannot be read: " + damage.what());
  }
  return found;
}

}  // namespace

SessionTrash::SessionTrash(const fs::path& sessions_folder)
    : sessions_(sessions_folder),
      folder_(sessions_folder.empty() ? fs::path() : sessions_folder.parent_path() / "trash") {
  std::vector<fs::path> left;
  std::error_code failed, ignored;
  for (fs::directory_iterator next(folder_, failed), end; !failed && next != end; next.increment(failed))
    if (next->path().filename().string().starts_with(being_erased)) left.push_back(next->path());
  for (const fs::path& each : left) fs::remove_all(each, ignored);
}

bool SessionTrash::has(const std::string& id) const {
  return !folder_.empty() && is_name(id) && is_folder(folder_of(id));
}

void SessionTrash::take(const std::string& id) {
  const std::lock_guard one_at_a_time(changing_);
  const fs::path folder = sessions_ / id;
  if (sessions_.empty() || !is_folder(folder)) throw Error(ErrorKind::not_found, "no session '" + id + "'");
  const auto lock = FileLock::attempt(lock_file(folder));
  if (!lock) throw Error(ErrorKind::conflict, "session '" + id + "' is in use; it can be deleted after that");
  if (has(id))
    throw Error(ErrorKind::conflict, "another session '" + id + "' was deleted before and is still kept");
  make_writable_folder(folder_);
  write_file_atomically(note_of(folder), json{{"deleted_utc", utc_now()}}.dump() + "\n");
  move_folder(folder, folder_of(id));
}

void SessionTrash::give_back(const std::string& id) {
  const std::lock_guard one_at_a_time(changing_);
  if (!has(id)) throw Error(ErrorKind::not_found, "no deleted session '" + id + "'");
  std::error_code failed;
  if (fs::exists(sessions_ / id, failed))
    throw Error(ErrorKind::conflict, "there is another session '" + id + "' by now");
  move_folder(folder_of(id), sessions_ / id);
  fs::remove(note_of(sessions_ / id), failed);
}

void SessionTrash::erase(const std::string& id) {
  const std::lock_guard one_at_a_time(changing_);
  if (!has(id)) return;
  const fs::path passing = folder_ / (being_erased + id + "-" + random_id());
  move_folder(folder_of(id), passing);
  std::error_code failed;
  fs::remove_all(passing, failed);
  if (failed)
    throw Error(ErrorKind::io, "session '" + id + "' could not be erased whole: " + passing.string() + ": " +
                                   failed.message());
}

std::vector<DeletedSession> SessionTrash::list() const {
  std::vector<DeletedSession> found;
  if (folder_.empty()) return found;
  for (const fs::path& path : paths_in(folder_))
    if (has(path.filename().string())) found.push_back(deleted_in(path));
  std::sort(found.begin(), found.end(), [](const DeletedSession& a, const DeletedSession& b) {
    return a.deleted_utc != b.deleted_utc ? a.deleted_utc > b.deleted_utc : a.id < b.id;
  });
  return found;
}

}  // namespace ream::session
