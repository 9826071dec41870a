#include "session/folder/index_upkeep.hpp"

#include <sys/stat.h>

#include <chrono>
#include <ctime>

#include "core/log.hpp"
#include "core/signal_handlers.hpp"
#include "session/folder/session_folder.hpp"

namespace ream::session {
namespace {

namespace fs = std::filesystem;

constexpr size_t batch = 200;
/// So many may be read from their folders for one list.
constexpr size_t few = 100;
constexpr std::chrono::seconds wait_timeout{5}, pause{1};

/// Of a folder: changes when a name in it comes or goes. Zero while it changed so lately that the file
/// system's clock could not tell another change.
int64_t stamp_of_names(const fs::path& folder) {
  struct stat about {};
  if (::stat(folder.c_str(), &about) != 0) return 0;
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  const auto ns = [](const timespec& time) { return time.tv_sec * int64_t{1'000'000'000} + time.tv_nsec; };
  constexpr int64_t settled_ns = 100'000'000;
  return ns(now) - ns(about.st_mtim) < settled_ns ? 0 : ns(about.st_mtim);
}

/// A folder as the index is to have it: no row when it is gone or cannot be read.
std::optional<store::SessionRow> row_from(const fs::path& folder) {
  const int64_t stamp = session_stamp(folder);
  if (stamp == 0) return std::nullopt;
  try {
    return read_session_row(folder, stamp);
  } catch (const Error& damage) {
    log::warn("session " + folder.filename().string() + " is left out: " + damage.what());
    return std::nullopt;
  }
}

}  // namespace

IndexUpkeep::IndexUpkeep(const SessionArchive& archive, store::Database& database)
    : archive_(archive), index_(database), thread_(start_thread([this] { work(); })) {}

IndexUpkeep::~IndexUpkeep() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void IndexUpkeep::changed(const std::string& id) {
  {
    const std::lock_guard lock(mutex_);
    waiting_[id] = ++changes_;
  }
  changed_.notify_all();
}

std::vector<std::string> IndexUpkeep::behind() {
  Lock lock(mutex_);
  if (compared_) {
    compare_names();
    compare_unsettled();
  }
  if (!changed_.wait_for(lock, wait_timeout,
                         [this] { return failure_ || (compared_ && waiting_.size() <= few); }))
    throw Error(ErrorKind::unavailable, "the index of sessions is being made, " +
                                            std::to_string(waiting_.size()) +
                                            " are still to be read; try again in a moment");
  if (failure_ && (!compared_ || waiting_.size() > few)) throw *failure_;
  std::vector<std::string> ids(unsettled_.begin(), unsettled_.end());
  for (const auto& [id, change] : waiting_)
    if (!unsettled_.contains(id)) ids.push_back(id);
  return ids;
}

void IndexUpkeep::work() {
  Lock lock(mutex_);
  while (wait_for_work(lock)) {
    try {
      if (!compared_) {
        lock.unlock();
        compare_all();
        lock.lock();
      } else {
        write_some(lock);
      }
      if (failure_) log::info("the index of sessions is written again");
      failure_.reset();
    } catch (const Error& failure) {
      if (!lock.owns_lock()) lock.lock();
      note_failure(failure);
    } catch (...) {
      log::current_exception("the index of sessions");
      if (!lock.owns_lock()) lock.lock();
      note_failure(Error(ErrorKind::unavailable, "it could not be written; the server's log says why"));
    }
    changed_.notify_all();
  }
}

/// False when it is time to end.
bool IndexUpkeep::wait_for_work(Lock& lock) {
  if (failure_) changed_.wait_for(lock, pause, [this] { return stopping_; });
  changed_.wait(lock, [this] { return stopping_ || !compared_ || !waiting_.empty(); });
  return !stopping_ || (compared_ && !waiting_.empty() && !failure_);
}

void IndexUpkeep::note_failure(const Error& failure) {
  if (!failure_) log::warn(std::string("the index of sessions waits: ") + failure.what());
  failure_ = failure;
}

/// Finds out what has changed since the index was last written.
void IndexUpkeep::compare_all() {
  const int64_t names_stamp = stamp_of_names(archive_.folder());
  std::map<std::string, store::SessionIndex::Mark> known = index_.marks();
  std::vector<std::string> differing;
  std::set<std::string> here;
  for (const std::string& id : archive_.ids()) {
    here.insert(id);
    const int64_t stamp = session_stamp(archive_.folder_of(id));
    const auto found = known.find(id);
    const bool same = found != known.end() && found->second.stamp == stamp && found->second.lasting;
    if (!same) differing.push_back(id);
  }
  for (const auto& [id, mark] : known)
    if (!here.contains(id)) differing.push_back(id);
  const std::lock_guard lock(mutex_);
  for (const std::string& id : differing) waiting_[id] = ++changes_;
  known_ = std::move(known);
  names_stamp_ = names_stamp;
  compared_ = true;
}

/// Notices folders that came or went without a word.
void IndexUpkeep::compare_names() {
  const int64_t stamp = stamp_of_names(archive_.folder());
  if (stamp != 0 && stamp == names_stamp_) return;
  const std::vector<std::string> ids = archive_.ids();
  names_stamp_ = stamp;
  const std::set<std::string> here(ids.begin(), ids.end());
  const size_t before = waiting_.size();
  for (const std::string& id : here)
    if (!known_.contains(id)) waiting_.try_emplace(id, ++changes_);
  for (const auto& [id, known] : known_)
    if (!here.contains(id)) waiting_.try_emplace(id, ++changes_);
  if (waiting_.size() != before) changed_.notify_all();
}

/// Notices those whose end was written without a word.
void IndexUpkeep::compare_unsettled() {
  bool found = false;
  for (const std::string& id : unsettled_)
    if (session_stamp(archive_.folder_of(id)) != known_.at(id).stamp)
      found = waiting_.try_emplace(id, ++changes_).second || found;
  if (found) changed_.notify_all();
}

void IndexUpkeep::write_some(Lock& lock) {
  std::map<std::string, uint64_t> some;
  for (const auto& each : waiting_)
    if (some.size() < batch) some.insert(each);
  lock.unlock();
  std::vector<store::SessionRow> rows;
  std::vector<std::string> without_row;
  for (const auto& [id, change] : some) {
    if (auto row = row_from(archive_.folder_of(id)))
      rows.push_back(std::move(*row));
    else
      without_row.push_back(id);
  }
  index_.put(rows);
  index_.remove(without_row);
  lock.lock();
  for (const store::SessionRow& row : rows) know(row.id, row.stamp, row.lasting);
  for (const std::string& id : without_row) forget_or_watch(id);
  for (const auto& [id, change] : some)
    if (const auto found = waiting_.find(id); found->second == change) waiting_.erase(found);
}

void IndexUpkeep::know(const std::string& id, int64_t stamp, bool lasting) {
  known_[id] = {stamp, lasting};
  if (lasting)
    unsettled_.erase(id);
  else
    unsettled_.insert(id);
}

/// A folder without a session that can be read may get one; no folder is no session.
void IndexUpkeep::forget_or_watch(const std::string& id) {
  std::error_code failed;
  if (fs::exists(archive_.folder_of(id), failed)) {
    know(id, session_stamp(archive_.folder_of(id)), false);
  } else {
    known_.erase(id);
    unsettled_.erase(id);
  }
}

size_t rebuild_index(const SessionArchive& archive, store::Database& database) {
  std::vector<store::SessionRow> rows;
  for (const std::string& id : archive.ids())
    if (auto row = row_from(archive.folder_of(id))) rows.push_back(std::move(*row));
  store::SessionIndex(database).replace_all(rows);
  return rows.size();
}

}  // namespace ream::session
