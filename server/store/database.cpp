#include "store/database.hpp"

#include <optional>
#include <random>
#include <stdexcept>
#include <thread>

#include "core/error.hpp"
#include "store/connection_pool.hpp"
#include "store/dialect.hpp"
#include "store/migrations.hpp"
#include "store/sql.hpp"

namespace ream::store {
namespace {

constexpr int max_attempts = 12;

/// Longer from attempt to attempt, and by chance, so that two that collided do not do so again.
void pause_before(int attempt) {
  thread_local std::mt19937 random{std::random_device{}()};
  std::uniform_int_distribution<int> pause_ms(0, std::min(1 << attempt, 100));
  std::this_thread::sleep_for(std::chrono::milliseconds(pause_ms(random)));
}

/// This thread is inside a transaction.
thread_local bool in_transaction = false;

class TransactionGuard {
 public:
  TransactionGuard() {
    if (in_transaction) throw std::logic_error("a database transaction inside another one");
    in_transaction = true;
  }
  ~TransactionGuard() { in_transaction = false; }
  TransactionGuard(const TransactionGuard&) = delete;
  TransactionGuard& operator=(const TransactionGuard&) = delete;
};

/// An unstorable text is the cause of what fails after it.
void run_action(Sql& sql, const std::function<void(Sql&)>& action) {
  forget_unstorable();
  try {
    action(sql);
  } catch (const soci::soci_error&) {
    refuse_unstorable();
    throw;
  }
  refuse_unstorable();
}

}  // namespace

/// One pool, and how a transaction goes on it.
class Database::Connections {
 public:
  Connections(const std::string& url, DatabaseLimits limits) : pool_(parse_database_url(url), limits) {}

  const DatabaseUrl& url() const { return pool_.url(); }

  /// Empty when the transaction is to be run again.
  bool attempt(Access access, const std::function<void(Sql&)>& action, bool last);

 private:
  void begin(Sql& sql, Access access) const;
  void roll_back(ConnectionPool::Lease& lease) noexcept;

  ConnectionPool pool_;
};

void Database::Connections::begin(Sql& sql, Access access) const {
  if (access == Access::write || access == Access::long_write)
    begin_writing(sql);
  else
    begin_reading(sql);
  if (access == Access::long_write || access == Access::long_read) lift_time_limit(sql);
}

bool Database::Connections::attempt(Access access, const std::function<void(Sql&)>& action, bool last) {
  const auto lease = pool_.take();
  const bool at_length = access == Access::long_read || access == Access::long_write;
  std::optional<Deadlines::Watch> watch;
  bool committing = false;
  try {
    if (!at_length) pool_.watch(lease->sql(), watch);
    begin(lease->sql(), access);
    run_action(lease->sql(), action);
    committing = true;
    lease->sql() << "COMMIT";
    return true;
  } catch (const soci::soci_error& error) {
    const SqlFailure failure = failure_of(error, connection_lost(lease->sql()), url().shown);
    if (!failure.lost) roll_back(*lease);
    watch.reset();
    if (failure.lost) {
      lease->drop();
      pool_.drop_idle();
    }
    // A connection that was lost while committing may have committed.
    const bool stale = failure.lost && url().postgresql && !lease->fresh() && !committing;
    if (last || !(stale || failure.again)) throw failure.error;
    return false;
  } catch (...) {
    roll_back(*lease);
    throw;
  }
}

void Database::Connections::roll_back(ConnectionPool::Lease& lease) noexcept {
  try {
    lease.sql() << "ROLLBACK";
  } catch (const std::exception&) {
    lease.drop();
  }
}

Database::Database(const std::string& url, DatabaseLimits limits)
    : connections_(std::make_unique<Connections>(url, limits)) {
  run_at_length(migrate);
}

Database::~Database() = default;

const std::string& Database::name() const { return connections_->url().shown; }

void Database::transact(Access access, const std::function<void(Sql&)>& action) {
  const TransactionGuard guard;
  for (int attempt = 1; !connections_->attempt(access, action, attempt == max_attempts); ++attempt)
    pause_before(attempt);
}

}  // namespace ream::store
