#include "session/service/session_service.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/log.hpp"
#include "core/new_id.hpp"
#include "session/folder/recorded_annotations.hpp"
#include "session/service/session_entry.hpp"

namespace ream::session {

SessionService::SessionService(SessionEngine& engine, SessionLimits limits,
                               const std::filesystem::path& sessions_folder, store::Database& database)
    : engine_(engine),
      limits_(limits),
      archive_(sessions_folder),
      trash_(sessions_folder),
      register_(archive_, database) {}

SessionService::~SessionService() { shut_down(); }

/// `leaving`: live ones that are about to end for it.
void SessionService::reserve_place(const std::string& trainee_id, bool by_trainee, size_t leaving) {
  const std::lock_guard lock(mutex_);
  if (closed_) throw Error(ErrorKind::unavailable, "the server is stopping");
  size_t live = being_made_.size(), own = being_made_.count(trainee_id);
  for (const auto& entry : entries_) {
    if (!entry->live()) continue;
    ++live;
    own += entry->request().trainee_id == trainee_id;
  }
  if (by_trainee && own >= limits_.of_trainee + leaving)
    throw Error(ErrorKind::conflict,
                std::to_string(limits_.of_trainee) +
                    " of your sessions are live, as many as a trainee may have at once; stop one first");
  if (live >= limits_.live + leaving)
    throw Error(ErrorKind::unavailable,
                std::to_string(limits_.live) +
                    " sessions are live, as many as this server runs at once; stop one first");
  being_made_.insert(trainee_id);
}

/// With the mutex held.
void SessionService::free_place(const std::string& trainee_id) {
  being_made_.erase(being_made_.find(trainee_id));
}

std::string SessionService::unused_id() const {
  for (;;) {
    const std::string id = random_id();
    const bool taken =
        std::any_of(entries_.begin(), entries_.end(), [&](const auto& entry) { return entry->id() == id; });
    std::error_code failed;
    if (!taken && !trash_.has(id) && !std::filesystem::exists(archive_.folder_of(id), failed)) return id;
  }
}

std::vector<std::shared_ptr<SessionService::Entry>> SessionService::take_surplus() {
  std::vector<std::shared_ptr<Entry>> surplus;
  auto ended = static_cast<size_t>(
      std::count_if(entries_.begin(), entries_.end(), [](const auto& entry) { return !entry->live(); }));
  for (auto entry = entries_.begin(); entry != entries_.end() && ended > limits_.kept;) {
    if ((*entry)->live() || (*entry)->running->stands_still()) {
      ++entry;
      continue;
    }
    surplus.push_back(std::move(*entry));
    entry = entries_.erase(entry);
    --ended;
  }
  return surplus;
}

SessionRecord SessionService::create(SessionRequest wanted, bool by_trainee) {
  return create_entry(std::move(wanted), by_trainee, 0)->record();
}

std::shared_ptr<SessionService::Entry> SessionService::create_entry(SessionRequest wanted, bool by_trainee,
                                                                    size_t leaving) {
  const std::string trainee_id = wanted.trainee_id;
  reserve_place(trainee_id, by_trainee, leaving);
  auto entry = std::make_shared<Entry>();
  try {
    {
      const std::lock_guard lock(mutex_);
      wanted.id = unused_id();
    }
    wanted.created_utc = utc_now_in_order();
    entry->label(std::move(wanted));
    entry->running = engine_.make(entry->request());
  } catch (...) {
    const std::lock_guard lock(mutex_);
    free_place(trainee_id);
    throw;
  }
  std::vector<std::shared_ptr<Entry>> surplus;  // destroyed after the lock: ending a session may take a while
  const std::lock_guard lock(mutex_);
  free_place(trainee_id);
  if (closed_) throw Error(ErrorKind::unavailable, "the server is stopping");
  entries_.push_back(entry);
  surplus = take_surplus();
  return entry;
}

std::shared_ptr<SessionService::Entry> SessionService::find_or_none(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  for (const auto& entry : entries_)
    if (entry->id() == id) return entry;
  return nullptr;
}

SessionRecord SessionService::archived(const std::string& id) const {
  if (auto record = archive_.find(id)) return *record;
  throw Error(ErrorKind::not_found, "no session '" + id + "'");
}

std::shared_ptr<SessionService::Entry> SessionService::find(const std::string& id) const {
  if (auto entry = find_or_none(id)) return entry;
  const SessionState state = archived(id).status.state;
  throw Error(ErrorKind::conflict,
              "session '" + id + "' is " + to_text(state) +
                  (is_live(state) ? " in another process" : "; it is only kept in its folder"));
}

std::vector<SessionRecord> SessionService::held() const {
  std::vector<std::shared_ptr<Entry>> entries;
  {
    const std::lock_guard lock(mutex_);
    entries = entries_;
  }
  std::vector<SessionRecord> records;
  for (const auto& entry : entries) records.push_back(entry->record());
  return records;
}

/// Of one that has ended, what is in its folder by now.
SessionRecord SessionService::with_mark(SessionRecord held) const {
  if (is_live(held.status.state)) return held;
  try {
    if (auto kept = archive_.find(held.request.id)) held.mark = std::move(kept->mark);
  } catch (const Error&) {
    // A folder that cannot be read keeps nobody from seeing what is in memory.
  }
  return held;
}

SessionPage SessionService::list(const store::SessionQuery& query) const {
  std::vector<SessionRecord> records = held();
  for (SessionRecord& record : records) record = with_mark(std::move(record));
  return register_.list(query, std::move(records));
}

SessionRecord SessionService::get(const std::string& id) const {
  const auto entry = find_or_none(id);
  return entry ? with_mark(entry->record()) : archived(id);
}

nlohmann::json SessionService::metrics(const std::string& id) const {
  const auto entry = find_or_none(id);
  std::error_code failed;
  const bool kept = std::filesystem::exists(metrics_json(archive_.folder_of(id)), failed);
  return entry && (entry->live() || !kept) ? entry->running->metrics() : archive_.metrics(id);
}

void SessionService::note_results(const std::string& id) { register_.changed(id); }

std::optional<Annotation> SessionService::annotate_live(const std::string& id, const NewAnnotation& note) {
  const auto entry = find_or_none(id);
  if (!entry) archived(id);
  if (!entry || !entry->live()) return std::nullopt;
  try {
    return entry->running->annotate(note);
  } catch (const Error&) {
    if (entry->live()) throw;
    return std::nullopt;  // it ended in the meantime
  }
}

Annotation SessionService::annotate(const std::string& id, const NewAnnotation& note) {
  if (auto kept = annotate_live(id, note)) return *kept;
  const std::lock_guard one_at_a_time(annotating_);  // and no resume begins meanwhile
  {
    const std::lock_guard lock(mutex_);
    if (being_resumed_.contains(id))
      throw Error(ErrorKind::conflict, "session '" + id +
                                           "' is being resumed; a remark can be made as soon "
                                           "as it runs");
  }
  if (auto kept = annotate_live(id, note)) return *kept;  // it may go on by now
  return annotate_recording(archive_.folder_of(id), note);
}

std::vector<Annotation> SessionService::annotations(const std::string& id) const {
  const auto entry = find_or_none(id);
  if (entry && entry->live()) return entry->running->annotations();
  if (!entry) archived(id);
  return recorded_annotations(archive_.folder_of(id));
}

std::filesystem::path SessionService::folder_of(const std::string& id) const {
  if (!find_or_none(id)) archived(id);
  return archive_.folder_of(id);
}

void SessionService::write_surface(const std::string& id, const std::filesystem::path& ply,
                                   int stride) const {
  find(id)->running->write_surface(ply, stride);
}

void SessionService::write_picture(const std::string& id, const std::filesystem::path& png) const {
  find(id)->running->write_picture(png);
}

std::unique_ptr<net::WebSocketSession> SessionService::subscribe(const std::string& id, int stride) const {
  auto entry = find(id);
  auto inner = entry->running->subscribe(stride);
  return std::make_unique<ViewerSocket>(std::move(entry), std::move(inner));
}

std::unique_ptr<net::WebSocketSession> SessionService::connect_device(const std::string& id) const {
  auto entry = find(id);
  auto inner = entry->running->connect_device();
  return std::make_unique<ViewerSocket>(std::move(entry), std::move(inner));
}

void SessionService::end_unused(std::chrono::steady_clock::time_point now) {
  std::vector<std::shared_ptr<Entry>> all;
  {
    const std::lock_guard lock(mutex_);
    all = entries_;
  }
  for (const auto& entry : all) {
    const std::lock_guard changing(entry->changing);
    const SessionState state = entry->running->status().state;
    if (state != SessionState::paused)
      entry->paused_since.reset();
    else if (!entry->paused_since)
      entry->paused_since = now;
    const bool unstarted =
        limits_.unstarted && state == SessionState::created && now - entry->made >= *limits_.unstarted;
    const bool left = limits_.paused && entry->paused_since && now - *entry->paused_since >= *limits_.paused;
    if (!unstarted && !left) continue;
    try {
      entry->running->stop();
      log::info("session " + entry->id() +
                " was ended: " + (unstarted ? "nobody started it" : "it was paused for too long"));
    } catch (const std::exception& failure) {
      log::error("session " + entry->id() + " could not be ended: " + failure.what());
    }
  }
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
      log::error("session " + entry->id() + " did not stop cleanly: " + failure.what());
    }
  }
}

}  // namespace ream::session
