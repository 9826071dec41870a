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
                               const std::filesystem::path& sessions_folder,
                               std::shared_ptr<store::Database> database)
    : engine_(engine),
      limits_(limits),
      archive_(sessions_folder),
      trash_(sessions_folder),
      register_(std::make_unique<SessionRegister>(archive_, std::move(database))) {}

SessionService::~SessionService() { shut_down(); }

void SessionService::reserve_place(size_t leaving) {
  const std::lock_guard lock(mutex_);
  if (closed_) throw Error(ErrorKind::unavailable, "the server is stopping");
  const auto live = static_cast<size_t>(
      std::count_if(entries_.begin(), entries_.end(), [](const auto& entry) { return entry->live(); }));
  if (live + being_made_ >= limits_.live + leaving)
    throw Error(ErrorKind::unavailable,
                std::to_string(limits_.live) +
                    " sessions are live, as many as this server runs at once; stop one first");
  ++being_made_;
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
  return create_entry(std::move(wanted), 0)->record();
}

/// `leaving`: live ones that are about to end for it.
std::shared_ptr<SessionService::Entry> SessionService::create_entry(SessionRequest wanted, size_t leaving) {
  reserve_place(leaving);
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
    --being_made_;
    throw;
  }
  std::vector<std::shared_ptr<Entry>> surplus;  // destroyed after the lock: ending a session may take a while
  const std::lock_guard lock(mutex_);
  --being_made_;
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
  throw Error(ErrorKind::not_found, "no session '" + id + "'; GET /api/v1/sessions lists them");
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
  return register_->list(query, std::move(records));
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

void SessionService::note_results(const std::string& id) { register_->changed(id); }

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
