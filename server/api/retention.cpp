#include "api/retention.hpp"

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/log.hpp"

namespace ream::api {
namespace {

constexpr std::chrono::hours day{24};
constexpr size_t page = 200;
/// After what has failed: the database may be away, or the index still be read.
constexpr std::chrono::milliseconds again_after = std::chrono::minutes(1);

/// A clock that is corrected by more than this was wrong; the day after is too early to trust it.
constexpr std::chrono::minutes even_within{10};
constexpr std::chrono::nanoseconds trusted_after = std::chrono::hours(24);
/// A long weekend. A server that was off for longer waits a day more, which does no harm.
constexpr std::chrono::hours max_off{96};
constexpr size_t always_may_go = 20;

std::string days_text(int days) { return std::to_string(days) + (days == 1 ? " day" : " days"); }

constexpr const char* until_trusted = "old sessions are deleted again when it has gone evenly for a day";

std::string moved_text(std::chrono::nanoseconds by) {
  const auto minutes = std::chrono::duration_cast<std::chrono::minutes>(by).count();
  return "the clock was moved by " + std::to_string(minutes) + " minutes while the server ran; " +
         until_trusted;
}

}  // namespace

std::chrono::nanoseconds time_since_boot() {
  timespec time{};
  ::clock_gettime(CLOCK_BOOTTIME, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

Retention::Retention(RetentionRules rules, RetentionTools tools)
    : rules_(std::move(rules)),
      tools_(std::move(tools)),
      even_(trusted_after),
      task_(
          "the rules of retention could not be carried out",
          [this] {
            look();
            return rules_.look_every;
          },
          std::min(rules_.look_every, again_after)) {}

void Retention::was_deleted() {
  if (rules_.keep_deleted_days <= 0) task_.wake();
}

std::string Retention::ends_utc(const std::string& deleted_utc) const {
  return ream::utc_text(utc_moment(deleted_utc) + day * rules_.keep_deleted_days);
}

/// One reading of the clock decides a whole look: what moves it meanwhile is found by the next.
std::string Retention::days_ago(int days) const { return ream::utc_text(last_reading_->wall - day * days); }

std::string Retention::held() const {
  const std::lock_guard lock(mutex_);
  return held_;
}

/// Goes on with what an earlier run knew of the clock.
void Retention::begin_with(UtcMoment wall) {
  std::error_code failed;
  if (rules_.clock_file.empty() || !std::filesystem::exists(rules_.clock_file, failed)) return;
  try {
    const nlohmann::json kept = read_json_file(rules_.clock_file);
    const std::string seen_utc = kept.at("seen_utc");
    const auto off = wall - utc_moment(seen_utc);
    even_ = std::chrono::seconds(kept.at("even_s").get<int64_t>());
    if (off > max_off || off < -even_within) {
      even_ = {};
      reason_ = "the clock says " + ream::utc_text(wall) + " at the start, and the server last ran at " +
                seen_utc + "; if it is wrong, set it; " + until_trusted;
    } else if (even_ < trusted_after) {
      reason_ = std::string("the clock was moved a short while ago; ") + until_trusted;
    }
  } catch (const std::exception& damaged) {
    even_ = {};
    reason_ = rules_.clock_file.string() + " cannot be read (" + damaged.what() + "); " + until_trusted;
  }
}

void Retention::remember(UtcMoment wall) const {
  if (rules_.clock_file.empty()) return;
  try {
    const auto even = std::chrono::duration_cast<std::chrono::seconds>(std::min(even_, trusted_after));
    write_json_file(rules_.clock_file, {{"seen_utc", ream::utc_text(wall)}, {"even_s", even.count()}});
  } catch (const Error& failure) {
    log::warn(std::string("how the clock goes cannot be kept: ") + failure.what());
  }
}

bool Retention::clock_is_even() {
  const ClockReading now{rules_.now(), rules_.running()};
  if (!last_reading_) {
    begin_with(now.wall);
  } else {
    const auto ran = now.running - last_reading_->running;
    const auto by = std::chrono::nanoseconds(now.wall - last_reading_->wall) - ran;
    even_ += ran;
    if (std::chrono::abs(by) > even_within) {
      even_ = {};
      reason_ = moved_text(by);
    }
  }
  last_reading_ = now;
  remember(now.wall);
  return even_ >= trusted_after;
}

bool Retention::may_go(size_t count, size_t of, const std::string& what) {
  if (count <= always_may_go || count * 100 <= of * static_cast<size_t>(rules_.max_at_once_percent))
    return true;
  reason_ = std::to_string(count) + " of " + std::to_string(of) + " " + what +
            " are due to go at once, more than " + std::to_string(rules_.max_at_once_percent) +
            " %; if the clock is right, start the server with --delete-at-once-percent 100";
  return false;
}

void Retention::look() {
  tools_.jobs.remove_old_results();
  const std::string before = reason_;
  if (clock_is_even()) {
    reason_.clear();
    tools_.idempotency.forget_old();
    if (rules_.keep_deleted_days > 0) erase_deleted_sessions();
    if (rules_.keep_sessions_days) delete_old_sessions();
  }
  if (rules_.keep_deleted_days == 0) erase_deleted_sessions();
  if (reason_ != before && !reason_.empty()) log::warn("nothing is deleted by the rules: " + reason_);
  const std::lock_guard lock(mutex_);
  held_ = reason_;
}

void Retention::audit(const std::string& action, const std::string& session_id, const std::string& detail) {
  tools_.audit_log.note({"", "retention", "", "", ""}, action, session_id, detail);
}

std::vector<session::SessionRecord> Retention::due_sessions(size_t& all) {
  store::SessionQuery query;
  query.limit = 1;
  all = tools_.sessions.list(query).total;
  query.created_before = days_ago(*rules_.keep_sessions_days);
  query.order = store::SessionOrder::created;
  query.descending = false;
  query.limit = page;
  std::vector<session::SessionRecord> due;
  do {
    session::SessionPage old = tools_.sessions.list(query);
    for (session::SessionRecord& record : old.sessions) {
      const session::SessionRequest& session = record.request;
      if (is_live(record.status.state) || session.keep) continue;
      if (session.study.empty() || tools_.studies.is_closed(session.study)) due.push_back(std::move(record));
    }
    query.cursor = old.next;
  } while (!query.cursor.empty() && !task_.stopping());
  return due;
}

void Retention::delete_old_sessions() {
  size_t all = 0;
  const std::vector<session::SessionRecord> due = due_sessions(all);
  if (!may_go(due.size(), all, "sessions")) return;
  for (const session::SessionRecord& record : due) {
    if (task_.stopping()) return;
    delete_by_rule(record);
  }
}

/// One that somebody uses at this moment waits for the next time.
void Retention::delete_by_rule(const session::SessionRecord& record) {
  const std::string& id = record.request.id;
  tools_.audit_log.require_writable();
  try {
    tools_.sessions.remove(id);
  } catch (const Error& failure) {
    if (failure.kind() != ErrorKind::conflict && failure.kind() != ErrorKind::not_found)
      log::warn("session " + id + " is old and could not be deleted: " + failure.what());
    return;
  }
  tools_.replays.stop_all_of(id);
  audit("session.delete", id, "by rule: older than " + days_text(rules_.keep_sessions_days.value_or(0)));
  tools_.feed.publish(
      {"session", id, "deleted", std::make_shared<const session::SessionRequest>(record.request)});
}

void Retention::erase_deleted_sessions() {
  const std::string before = days_ago(rules_.keep_deleted_days);
  std::vector<session::DeletedSession> due = tools_.sessions.deleted();
  const size_t in_trash = due.size();
  if (rules_.keep_deleted_days > 0) {
    std::erase_if(due, [&](const session::DeletedSession& deleted) { return deleted.deleted_utc > before; });
    store::SessionQuery one;
    one.limit = 1;
    if (!due.empty() &&
        !may_go(due.size(), in_trash + tools_.sessions.list(one).total, "sessions and deleted ones"))
      return;
  }
  for (const session::DeletedSession& deleted : due) {
    if (task_.stopping()) return;
    erase(deleted);
  }
}

void Retention::erase(const session::DeletedSession& deleted) {
  tools_.audit_log.require_writable();
  try {
    tools_.sessions.erase(deleted.id);
    tools_.idempotency.forget_about(deleted.id);
  } catch (const Error& failure) {
    log::warn(failure.what());
    return;
  }
  audit("session.erase", deleted.id,
        "by rule: deleted more than " + days_text(rules_.keep_deleted_days) + " ago");
  tools_.feed.publish({"session", deleted.id, "erased"});
}

}  // namespace ream::api
