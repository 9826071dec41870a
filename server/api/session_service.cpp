#include "api/session_service.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "api/keeping_session.hpp"
#include "api/new_id.hpp"
#include "core/error.hpp"
#include "core/log.hpp"

namespace ream::api {

struct SessionService::Entry {
  SessionRequest request;
  std::string created_utc;
  std::unique_ptr<RunningSession> running;
  std::mutex changing;  ///< one start or stop at a time

  SessionRecord record() const { return {request, created_utc, running->status()}; }
  bool live() const { return is_live(running->status().state); }
};

SessionService::SessionService(SessionFactory factory, SessionLimits limits)
    : factory_(std::move(factory)), limits_(limits) {}

SessionService::~SessionService() { shut_down(); }

void SessionService::reserve_place() {
  const std::lock_guard lock(mutex_);
  if (closed_) throw Error(ErrorKind::unavailable, "the server is stopping");
  const auto live = static_cast<size_t>(
      std::count_if(entries_.begin(), entries_.end(), [](const auto& entry) { return entry->live(); }));
  if (live + being_made_ >= limits_.live)
    throw Error(ErrorKind::unavailable,
                std::to_string(limits_.live) +
                    " sessions are live, as many as this server runs at once; stop one first");
  ++being_made_;
}

std::string SessionService::unused_id() const {
  for (;;) {
    const std::string id = random_id();
    const bool taken = std::any_of(entries_.begin(), entries_.end(),
                                   [&](const auto& entry) { return entry->request.id == id; });
    if (!taken) return id;
  }
}

std::vector<std::shared_ptr<SessionService::Entry>> SessionService::take_surplus() {
  std::vector<std::shared_ptr<Entry>> surplus;
  auto ended = static_cast<size_t>(
      std::count_if(entries_.begin(), entries_.end(), [](const auto& entry) { return !entry->live(); }));
  for (auto entry = entries_.begin(); entry != entries_.end() && ended > limits_.kept;) {
    if ((*entry)->live()) {
      ++entry;
      continue;
    }
    surplus.push_back(std::move(*entry));
    entry = entries_.erase(entry);
    --ended;
  }
  return surplus;
}

SessionRecord SessionService::create(SessionRequest wanted) {
  reserve_place();
  auto entry = std::make_shared<Entry>();
  try {
    {
      const std::lock_guard lock(mutex_);
      wanted.id = unused_id();
    }
    entry->request = std::move(wanted);
    entry->created_utc = utc_now();
    entry->running = factory_(entry->request);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    --being_made_;
    throw;
  }
  std::vector<std::shared_ptr<Entry>> surplus;  // destroyed after the lock: ending a session may take a while
  const std::lock_guard lock(mutex_);
  --being_made_;
  if (closed_) throw Error(ErrorKind::unavailable, "the server is stopping");
  entries_.push_back(entry);
  surplus = take_surplus();
  return entry->record();
}

std::shared_ptr<SessionService::Entry> SessionService::find(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  for (const auto& entry : entries_)
    if (entry->request.id == id) return entry;
  throw Error(ErrorKind::not_found, "no session '" + id + "'; GET /api/v1/sessions lists them");
}

std::vector<SessionRecord> SessionService::list() const {
  std::vector<std::shared_ptr<Entry>> entries;
  {
    const std::lock_guard lock(mutex_);
    entries = entries_;
  }
  std::vector<SessionRecord> records;
  for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) records.push_back((*entry)->record());
  return records;
}

SessionRecord SessionService::get(const std::string& id) const { return find(id)->record(); }

SessionRecord SessionService::start(const std::string& id) {
  const auto entry = find(id);
  const std::lock_guard changing(entry->changing);
  {
    const std::lock_guard lock(mutex_);
    if (closed_) throw Error(ErrorKind::unavailable, "the server is stopping");
  }
  const SessionState state = entry->running->status().state;
  if (state != SessionState::created)
    throw Error(ErrorKind::conflict,
                "session '" + id + "' is " + to_text(state) + "; only a created session can be started");
  entry->running->start();
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

nlohmann::json SessionService::metrics(const std::string& id) const { return find(id)->running->metrics(); }

std::unique_ptr<net::WebSocketSession> SessionService::subscribe(const std::string& id, int stride) const {
  auto entry = find(id);
  auto inner = entry->running->subscribe(stride);
  return std::make_unique<KeepingSession>(std::move(entry), std::move(inner));
}

void SessionService::shut_down() {
  std::vector<std::shared_ptr<Entry>> entries;
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    entries = entries_;
  }
  for (const auto& entry : entries) {
    const std::lock_guard changing(entry->changing);
    try {
      if (entry->live()) entry->running->stop();
    } catch (const std::exception& failure) {
      log::error("session " + entry->request.id + " did not stop cleanly: " + failure.what());
    }
  }
}

}  // namespace ream::api
