#include "api/database_watch.hpp"

#include "core/error.hpp"
#include "core/log.hpp"
#include "store/sql.hpp"

namespace ream::api {
namespace {

constexpr std::chrono::seconds period{2};

}  // namespace

DatabaseWatch::DatabaseWatch(std::shared_ptr<store::Database> database)
    : database_(std::move(database)), task_("the watch over the database", [this] {
        note(look());
        return period;
      }) {}

void DatabaseWatch::require_there() const {
  const std::lock_guard lock(mutex_);
  // Anybody may ask; the log has the reason.
  if (!problem_.empty()) throw Error(ErrorKind::unavailable, "the database does not answer");
}

std::string DatabaseWatch::look() const {
  try {
    database_->read([](store::Sql& sql) {
      int steps = 0;
      sql << "SELECT count(*) FROM migrations", store::into(steps);
      return steps;
    });
    return {};
  } catch (const Error& failure) {
    return failure.what();
  }
}

void DatabaseWatch::note(std::string problem) {
  const std::lock_guard lock(mutex_);
  const bool failed = !problem.empty(), was_away = !problem_.empty();
  // One that is too busy for a moment is not away.
  const bool away = failed && (failed_before_ || was_away);
  failed_before_ = failed;
  if (away && !was_away) log::error("the database does not answer: " + problem);
  if (!failed && was_away) log::info("the database answers again");
  problem_ = away ? std::move(problem) : "";
}

}  // namespace ream::api
