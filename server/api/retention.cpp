#include "api/retention.hpp"

#include <chrono>

#include "core/error.hpp"
#include "core/log.hpp"
#include "core/thread_pool.hpp"

namespace ream::api {
namespace {

constexpr std::chrono::hours day{24};
constexpr size_t page = 200;
/// After what has failed: the database may be away, or the index still be read.
constexpr std::chrono::milliseconds again_after = std::chrono::minutes(1);

std::string days_text(int days) { return std::to_string(days) + (days == 1 ? " day" : " days"); }

}  // namespace

Retention::Retention(RetentionRules rules, RetentionTools tools)
    : rules_(std::move(rules)), tools_(std::move(tools)) {}

Retention::~Retention() { stop(); }

void Retention::begin() {
  thread_ = std::thread([this] { work(); });
}

void Retention::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Retention::was_deleted() {
  if (rules_.keep_deleted_days > 0) return;
  {
    const std::lock_guard lock(mutex_);
    look_wanted_ = true;
  }
  changed_.notify_all();
}

std::string Retention::ends_utc(const std::string& deleted_utc) const {
  return ream::utc_text(utc_moment(deleted_utc) + day * rules_.keep_deleted_days);
}

std::string Retention::days_ago(int days) const { return ream::utc_text(rules_.now() - day * days); }

bool Retention::stopping() {
  const std::lock_guard lock(mutex_);
  return stopping_;
}

void Retention::work() {
  lower_thread_priority();
  std::unique_lock lock(mutex_);
  std::chrono::milliseconds wait{0};
  while (!stopping_) {
    changed_.wait_for(lock, wait, [this] { return stopping_ || look_wanted_; });
    if (stopping_) return;
    look_wanted_ = false;
    lock.unlock();
    wait = rules_.look_every;
    try {
      look();
    } catch (const std::exception& failure) {
      log::warn(std::string("the rules of retention could not be carried out: ") + failure.what());
      wait = std::min(wait, again_after);
    }
    lock.lock();
  }
}

void Retention::look() {
  tools_.jobs.remove_old_results();
  erase_deleted_sessions();
  if (rules_.keep_sessions_days) delete_old_sessions();
  if (rules_.keep_deleted_days == 0) erase_deleted_sessions();
}

void Retention::delete_old_sessions() {
  store::SessionQuery query;
  query.created_before = days_ago(*rules_.keep_sessions_days);
  query.order = store::SessionOrder::created;
  query.descending = false;
  query.limit = page;
  do {
    const session::SessionPage old = tools_.sessions.list(query);
    for (const session::SessionRecord& record : old.sessions) {
      if (stopping()) return;
      const session::SessionRequest& session = record.request;
      if (is_live(record.status.state) || session.keep) continue;
      if (session.study.empty() || tools_.is_over(session.study)) delete_by_rule(record);
    }
    query.cursor = old.next;
  } while (!query.cursor.empty());
}

/// One that somebody uses at this moment waits for the next time.
void Retention::delete_by_rule(const session::SessionRecord& record) {
  const std::string& id = record.request.id;
  try {
    tools_.sessions.remove(id);
  } catch (const Error& failure) {
    if (failure.kind() != ErrorKind::conflict && failure.kind() != ErrorKind::not_found)
      log::warn("session " + id + " is old and could not be deleted: " + failure.what());
    return;
  }
  tools_.replays.stop_all_of(id);
  tools_.audit("session.delete", id,
               "by rule: older than " + days_text(rules_.keep_sessions_days.value_or(0)));
  tools_.feed.tell(
      {"session", id, "deleted", std::make_shared<const session::SessionRequest>(record.request)});
}

void Retention::erase_deleted_sessions() {
  const std::string before = days_ago(rules_.keep_deleted_days);
  for (const session::DeletedSession& deleted : tools_.sessions.deleted()) {
    if (stopping()) return;
    if (deleted.deleted_utc > before) continue;
    try {
      tools_.sessions.erase(deleted.id);
    } catch (const Error& failure) {
      log::warn(failure.what());
      continue;
    }
    tools_.audit("session.erase", deleted.id,
                 "by rule: deleted more than " + days_text(rules_.keep_deleted_days) + " ago");
    tools_.feed.tell({"session", deleted.id, "erased"});
  }
}

}  // namespace ream::api
