#include "session/service/replay_service.hpp"

#include <algorithm>
#include <atomic>
#include <nlohmann/json.hpp>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "core/new_id.hpp"
#include "session/service/session_socket.hpp"

namespace ream::session {

struct ReplayService::Entry {
  ReplayRequest request;
  std::string created_utc;
  std::unique_ptr<RunningReplay> running;
  std::atomic<int64_t> asked_ns{steady_ns()};  ///< when somebody last named it

  bool unattended_for(std::chrono::nanoseconds time) const {
    return steady_ns() - asked_ns > time.count() &&
           running->status().unwatched_s > std::chrono::duration<double>(time).count();
  }
  ReplayRecord record(bool open = true) const {
    return {request, created_utc, open, running->status(), running->marks()};
  }
};

ReplayService::ReplayService(SessionEngine& engine, ReplayLimits limits)
    : engine_(engine),
      limits_(limits),
      cleanup_(
          "a replay that nobody watches could not be ended",
          [this] {
            end_unattended();
            return limits_.look_every;
          },
          limits_.look_every) {
  cleanup_.start(limits_.look_every, false);
}

void ReplayService::end_unattended() {
  for (const auto& entry : take_unattended()) {
    log::info("replay of session " + entry->request.replay_of + " ends: nobody has watched it for long");
    entry->running->stop();
  }
}

ReplayService::Entries ReplayService::take_unattended() {
  const std::lock_guard lock(mutex_);
  const auto first = std::stable_partition(entries_.begin(), entries_.end(), [this](const auto& entry) {
    return !entry->unattended_for(limits_.unattended);
  });
  Entries taken(first, entries_.end());
  entries_.erase(first, entries_.end());
  return taken;
}

/// Gives the replay that has to go for it, if any.
std::shared_ptr<ReplayService::Entry> ReplayService::reserve_place(const std::string& caller) {
  const std::lock_guard lock(mutex_);
  if (closed_) throw Error(ErrorKind::unavailable, "the server is stopping");
  std::shared_ptr<Entry> leaving;
  const auto is_own = [&](const auto& entry) { return entry->request.counted_for == caller; };
  const size_t own = being_made_.count(caller) +
                     static_cast<size_t>(std::count_if(entries_.begin(), entries_.end(), is_own));
  const bool only_own = !caller.empty() && own >= limits_.of_caller;
  if (only_own || entries_.size() + being_made_.size() >= limits_.open) {
    auto least_watched = entries_.end();
    double unwatched_s = 0.0;
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry)
      if (const double s = (*entry)->running->status().unwatched_s;
          s > unwatched_s && (!only_own || is_own(*entry))) {
        least_watched = entry;
        unwatched_s = s;
      }
    if (least_watched == entries_.end() && only_own)
      throw Error(ErrorKind::conflict, std::to_string(limits_.of_caller) +
                                           " of your replays are watched, as many as you may have at once; "
                                           "stop one first");
    if (least_watched == entries_.end())
      throw Error(ErrorKind::unavailable,
                  std::to_string(limits_.open) +
                      " replays are watched, as many as this server shows at once; stop one first");
    leaving = std::move(*least_watched);
    entries_.erase(least_watched);
  }
  being_made_.insert(caller);
  return leaving;
}

ReplayRecord ReplayService::create(ReplayRequest wanted) {
  const std::string caller = wanted.counted_for;
  reserve_place(caller).reset();
  auto entry = std::make_shared<Entry>();
  try {
    wanted.id = "r" + random_id();  // longer than any session's, so that it is none's
    entry->request = std::move(wanted);
    entry->created_utc = utc_now();
    entry->running = engine_.replay(entry->request);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    free_place(caller);
    throw;
  }
  const std::lock_guard lock(mutex_);
  free_place(caller);
  if (closed_) throw Error(ErrorKind::unavailable, "the server is stopping");
  entries_.push_back(entry);
  return entry->record();
}

std::shared_ptr<ReplayService::Entry> ReplayService::find(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  for (const auto& entry : entries_)
    if (entry->request.id == id) {
      entry->asked_ns = steady_ns();
      return entry;
    }
  throw Error(ErrorKind::not_found, "no replay '" + id + "'; it has ended or never was");
}

bool ReplayService::has(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const auto& entry) { return entry->request.id == id; });
}

std::vector<ReplayRecord> ReplayService::list() const {
  Entries entries;
  {
    const std::lock_guard lock(mutex_);
    entries = entries_;
  }
  std::vector<ReplayRecord> records;
  for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) records.push_back((*entry)->record());
  return records;
}

ReplayRecord ReplayService::get(const std::string& id) const { return find(id)->record(); }

ReplayRecord ReplayService::change(const std::string& id, const PlaybackChange& change) {
  const auto entry = find(id);
  entry->running->change(change);
  return entry->record();
}

ReplayRecord ReplayService::stop(const std::string& id) {
  const auto entry = find(id);
  {
    const std::lock_guard lock(mutex_);
    std::erase(entries_, entry);
  }
  entry->running->stop();
  return entry->record(false);
}

void ReplayService::stop_all_of(const std::string& session_id) {
  Entries ended;
  {
    const std::lock_guard lock(mutex_);
    const auto first = std::stable_partition(entries_.begin(), entries_.end(), [&](const auto& entry) {
      return entry->request.replay_of != session_id;
    });
    ended.assign(first, entries_.end());
    entries_.erase(first, entries_.end());
  }
  for (const auto& entry : ended) entry->running->stop();
}

nlohmann::json ReplayService::metrics(const std::string& id) const { return find(id)->running->metrics(); }

std::unique_ptr<net::WebSocketSession> ReplayService::subscribe(const std::string& id, int stride) const {
  auto entry = find(id);
  auto inner = entry->running->subscribe(stride);
  return std::make_unique<SessionSocket>(std::move(entry), std::move(inner));
}

void ReplayService::shut_down() {
  Entries entries;
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    entries.swap(entries_);
  }
  for (const auto& entry : entries) entry->running->stop();
}

}  // namespace ream::session
