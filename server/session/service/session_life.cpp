#include <algorithm>

#include "core/error.hpp"
#include "core/log.hpp"
#include "session/service/session_entry.hpp"

namespace ream::session {

SessionRecord SessionService::start(const std::string& id) {
  const auto entry = find(id);
  const std::lock_guard changing(entry->changing);
  {
    const std::lock_guard lock(mutex_);
    if (closed_) throw Error(ErrorKind::unavailable, "the server is stopping");
  }
  const SessionStatus status = entry->running->status();
  if (status.state == SessionState::paused && !status.held)
    throw Error(ErrorKind::conflict,
                "session '" + id + "' is paused by its own device and goes on when that does");
  if (status.state != SessionState::created && !status.held)
    throw Error(ErrorKind::conflict, "session '" + id + "' is " + to_text(status.state) +
                                         "; only a created or paused session can be started");
  if (status.held)
    entry->running->unpause();
  else
    entry->running->start();
  return entry->record();
}

SessionRecord SessionService::pause(const std::string& id) {
  const auto entry = find(id);
  const std::lock_guard changing(entry->changing);
  const SessionStatus status = entry->running->status();
  const bool under_way = status.state == SessionState::running || status.state == SessionState::paused;
  if (!under_way || status.held)
    throw Error(ErrorKind::conflict, "session '" + id + "' is " + to_text(status.state) +
                                         (under_way ? " already" : "; only a running session can be paused"));
  entry->running->pause();
  return entry->record();
}

SessionRecord SessionService::stop(const std::string& id) {
  const auto entry = find(id);
  const std::lock_guard changing(entry->changing);
  const SessionState state = entry->running->status().state;
  if (!is_live(state))
    throw Error(ErrorKind::conflict, "session '" + id + "' has ended already: it is " + to_text(state));
  entry->running->stop();
  return entry->record();
}

SessionRecord SessionService::change(const std::string& id, const SessionChange& change) {
  const std::lock_guard one_at_a_time(labelling_);
  SessionRequest labels = get(id).request;
  apply(change, labels);
  relabel(id, labels);
  return get(id);
}

/// With labelling_ held.
void SessionService::relabel(const std::string& id, const SessionRequest& labels) {
  const auto entry = find_or_none(id);
  std::error_code failed;
  const bool written = entry && entry->running->relabel(labels);
  if (!written && (!entry || std::filesystem::exists(session_json(archive_.folder_of(id)), failed)))
    relabel_folder(archive_.folder_of(id), labels);
  if (entry) entry->label(labels);
  register_.changed(id);
}

SessionRequest SessionService::next_attempt(const SessionRecord& before) const {
  SessionRequest next = before.request;
  if (const std::string& taken = next.followed_by;
      !taken.empty() && (find_or_none(taken) || archive_.find(taken)))
    throw Error(ErrorKind::conflict,
                "session '" + next.id + "' was reset before; it goes on as '" + taken + "'");
  next.reset_of = next.id;
  next.attempt += 1;
  next.force_scale = before.status.force_scale;
  next.followed_by.clear();
  next.keep = false;
  return next;
}

/// The new one stands before the old one ends, so that nothing is lost where it cannot be made; meanwhile the
/// hand holds nothing.
SessionRecord SessionService::restart(const SessionRecord& before, bool by_trainee) {
  const std::string& id = before.request.id;
  const auto old = is_live(before.status.state) ? find(id) : find_or_none(id);
  const bool ran =
      before.status.state == SessionState::running || before.status.state == SessionState::paused;
  const bool held_here = ran && !before.status.held;
  SessionRequest wanted = next_attempt(before);
  if (held_here) old->running->pause();
  std::shared_ptr<Entry> next;
  try {
    next = create_entry(std::move(wanted), by_trainee, old && old->live() ? 1 : 0);
  } catch (...) {
    if (held_here) old->running->unpause();
    throw;
  }
  if (old) {
    const std::lock_guard changing(old->changing);
    if (old->live()) old->running->stop();
  }
  try {
    const std::lock_guard one_at_a_time(labelling_);
    SessionRequest labels = get(id).request;
    labels.followed_by = next->id();
    relabel(id, labels);
  } catch (const Error& error) {
    log::warn("session " + id + " goes on as " + next->id() + ", but does not say so: " + error.what());
  }
  try {
    if (ran) start(next->id());
  } catch (const Error& error) {
    log::warn("session " + next->id() + " was created again but does not run: " + error.what());
  }
  return next->record();
}

SessionRecord SessionService::reset(const std::string& id, bool by_trainee) {
  {
    const std::lock_guard lock(mutex_);
    if (!being_reset_.insert(id).second)
      throw Error(ErrorKind::conflict, "session '" + id + "' is being reset already");
  }
  const auto done = [this, &id] {
    const std::lock_guard lock(mutex_);
    being_reset_.erase(id);
  };
  try {
    const SessionRecord next = restart(get(id), by_trainee);
    done();
    return next;
  } catch (...) {
    done();
    throw;
  }
}

std::shared_ptr<SessionService::Entry> SessionService::reopen_entry(const SessionRecord& before,
                                                                    const std::string& reamer) {
  auto entry = std::make_shared<Entry>();
  entry->label(before.request);
  entry->running = engine_.resume(before.request, reamer);
  entry->running->start();
  return entry;
}

SessionRecord SessionService::resume(const std::string& id, const std::string& reamer, bool by_trainee) {
  const SessionRecord before = get(id);
  const SessionState state = before.status.state;
  if (state != SessionState::interrupted && state != SessionState::stopped)
    throw Error(ErrorKind::conflict, "session '" + id + "' is " + to_text(state) +
                                         "; only an interrupted or stopped session can go on");
  {
    const std::lock_guard no_remark(annotating_);
    const std::lock_guard lock(mutex_);
    if (!being_resumed_.insert(id).second)
      throw Error(ErrorKind::conflict, "session '" + id + "' is being resumed already");
  }
  const std::string& trainee_id = before.request.trainee_id;
  const auto done = [&](bool reserved) {
    being_resumed_.erase(id);
    if (reserved) free_place(trainee_id);
  };
  std::shared_ptr<Entry> entry, old;
  bool reserved = false;
  try {
    reserve_place(trainee_id, by_trainee);
    reserved = true;
    entry = reopen_entry(before, reamer);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    done(reserved);
    throw;
  }
  const std::lock_guard lock(mutex_);
  done(true);
  if (closed_) throw Error(ErrorKind::unavailable, "the server is stopping");
  const auto place =
      std::find_if(entries_.begin(), entries_.end(), [&](const auto& other) { return other->id() == id; });
  if (place != entries_.end()) {
    old = std::move(*place);
    entries_.erase(place);
  }
  entries_.push_back(entry);
  register_.changed(id);
  return entry->record();
}

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
    for (auto entry = first; entry != entries_.end(); ++entry)
      ((*entry)->running->stands_still() ? standing_ : gone).push_back(std::move(*entry));
    entries_.erase(first, entries_.end());
  }
  register_.changed(id);
  record.streamable = false;
  return record;
}

SessionRecord SessionService::restore(const std::string& id) {
  if (find_or_none(id)) throw Error(ErrorKind::conflict, "session '" + id + "' is not deleted");
  std::error_code failed;
  if (!trash_.has(id) && std::filesystem::exists(archive_.folder_of(id), failed))
    throw Error(ErrorKind::conflict, "session '" + id + "' is not deleted");
  trash_.give_back(id);
  register_.changed(id);
  return archived(id);
}

void SessionService::erase(const std::string& id) { trash_.erase(id); }

std::vector<DeletedSession> SessionService::deleted() const { return trash_.list(); }

}  // namespace ream::session
