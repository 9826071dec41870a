#include <algorithm>

#include "core/error.hpp"
#include "session/service/session_entry.hpp"

namespace ream::session {

/// First out of the folders, then out of memory and index: whatever happens in between, they follow.
SessionRecord SessionService::remove(const std::string& id) {
  const std::lock_guard one_at_a_time(labelling_);
  SessionRecord record = get(id);
  if (is_live(record.status.state))
    throw Error(ErrorKind::conflict,
                "session '" + id + "' is " + to_text(record.status.state) + "; stop it before it is deleted");
  if (record.request.keep)
    throw Error(ErrorKind::conflict, "session '" + id + "' is kept for good; take that off it first");
  std::error_code failed;
  if (std::filesystem::exists(archive_.folder_of(id), failed)) trash_.take(id);
  std::vector<std::shared_ptr<Entry>> gone;  // destroyed after the lock
  {
    const std::lock_guard lock(mutex_);
    const auto first = std::stable_partition(entries_.begin(), entries_.end(),
                                             [&](const auto& entry) { return entry->id() != id; });
    gone.assign(std::make_move_iterator(first), std::make_move_iterator(entries_.end()));
    entries_.erase(first, entries_.end());
  }
  register_->changed(id);
  record.streamable = false;
  return record;
}

SessionRecord SessionService::restore(const std::string& id) {
  if (find_or_none(id)) throw Error(ErrorKind::conflict, "session '" + id + "' is not deleted");
  std::error_code failed;
  if (!trash_.has(id) && std::filesystem::exists(archive_.folder_of(id), failed))
    throw Error(ErrorKind::conflict, "session '" + id + "' is not deleted");
  trash_.give_back(id);
  register_->changed(id);
  return archived(id);
}

void SessionService::erase(const std::string& id) { trash_.erase(id); }

std::vector<DeletedSession> SessionService::deleted() const { return trash_.list(); }

}  // namespace ream::session
