#include "api/session_service.hpp"

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>
#include <random>

#include "core/error.hpp"
#include "core/log.hpp"

namespace ream::api {
namespace {

constexpr size_t id_length = 8;

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

/// Without letters that are easily taken for one another when read aloud or typed.
std::string random_id() {
  static constexpr std::string_view letters = "23456789abcdefghjkmnpqrstuvwxyz";
  std::random_device entropy;
  std::uniform_int_distribution<size_t> pick(0, letters.size() - 1);
  std::string id;
  for (size_t i = 0; i < id_length; ++i) id += letters[pick(entropy)];
  return id;
}

/// A viewer's connection, which keeps the session it looks at.
class KeepingSession final : public net::WebSocketSession {
 public:
  KeepingSession(std::shared_ptr<void> kept, std::unique_ptr<net::WebSocketSession> inner)
      : kept_(std::move(kept)), inner_(std::move(inner)) {}
  void on_open(std::function<void()> wake) override { inner_->on_open(std::move(wake)); }
  std::optional<net::SharedBytes> next() override { return inner_->next(); }
  void on_message(std::span<const std::byte> message) override { inner_->on_message(message); }
  void on_close() noexcept override { inner_->on_close(); }

 private:
  std::shared_ptr<void> kept_;
  std::unique_ptr<net::WebSocketSession> inner_;
};

}  // namespace

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
