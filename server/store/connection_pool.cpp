#include "store/connection_pool.hpp"

#include <sys/socket.h>
#include <algorithm>
#include <utility>

#include "core/signal_handlers.hpp"
#include "store/dialect.hpp"
#include "store/sql.hpp"

namespace ream::store {

Deadlines::Deadlines() : thread_(start_thread([this] { work(); })) {}

Deadlines::~Deadlines() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

Deadlines::Watch::Watch(Deadlines& deadlines, int socket, SteadyClock::time_point end)
    : deadlines_(deadlines) {
  const std::lock_guard lock(deadlines_.mutex_);
  place_ = deadlines_.sockets_.emplace(end, socket);
  if (place_ == deadlines_.sockets_.begin()) deadlines_.changed_.notify_all();
}

Deadlines::Watch::~Watch() {
  const std::lock_guard lock(deadlines_.mutex_);
  deadlines_.sockets_.erase(place_);
}

void Deadlines::work() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    const auto now = SteadyClock::now();
    auto next = sockets_.begin();
    for (; next != sockets_.end() && next->first <= now; ++next)
      if (const int socket = std::exchange(next->second, -1); socket >= 0) ::shutdown(socket, SHUT_RDWR);
    if (next == sockets_.end())
      changed_.wait(lock);
    else
      changed_.wait_until(lock, SteadyClock::time_point(next->first));
  }
}

ConnectionPool::Lease::Lease(ConnectionPool& pool, std::unique_ptr<Sql> sql, bool fresh)
    : pool_(pool), sql_(std::move(sql)), fresh_(fresh) {}

ConnectionPool::Lease::~Lease() { pool_.give_back(std::move(sql_)); }

void ConnectionPool::Lease::drop() { sql_.reset(); }

ConnectionPool::ConnectionPool(DatabaseUrl url, DatabaseLimits limits)
    : url_(std::move(url)),
      limits_(limits),
      deadlines_(url_.postgresql ? std::make_unique<Deadlines>() : nullptr) {}

ConnectionPool::~ConnectionPool() = default;

std::unique_ptr<ConnectionPool::Lease> ConnectionPool::take() {
  {
    std::unique_lock lock(mutex_);
    if (!freed_.wait_for(lock, limits_.timeout, [this] { return in_use_ < limits_.connections; }))
      throw Error(ErrorKind::unavailable,
                  "the database at " + url_.shown + " is busy (all connections are in use); try again");
    ++in_use_;
    if (!idle_.empty()) {
      auto sql = std::move(idle_.back());
      idle_.pop_back();
      return std::make_unique<Lease>(*this, std::move(sql), false);
    }
  }
  try {
    return std::make_unique<Lease>(*this, open(), true);
  } catch (...) {
    give_back(nullptr);
    throw;
  }
}

std::unique_ptr<Sql> ConnectionPool::open() {
  const auto began = SteadyClock::now();
  {
    const std::lock_guard lock(mutex_);
    if (last_failure_ && (attempting_ || began < next_attempt_)) throw *last_failure_;
    attempting_ = true;
  }
  try {
    auto sql = open_connection(url_, limits_);
    const std::lock_guard lock(mutex_);
    attempting_ = false;
    last_failure_.reset();
    return sql;
  } catch (const soci::soci_error& error) {
    const Error failure = failure_of(error, true, url_.shown).error;
    note_failure(failure, began);
    throw failure;
  } catch (const Error& failure) {
    note_failure(failure, began);
    throw;
  }
}

/// One that took long to fail is not soon tried again.
void ConnectionPool::note_failure(const Error& failure, SteadyClock::time_point began) {
  const auto now = SteadyClock::now();
  const std::lock_guard lock(mutex_);
  attempting_ = false;
  last_failure_ = failure;
  next_attempt_ = now + std::max<SteadyClock::duration>(limits_.pause, now - began);
}

void ConnectionPool::watch(Sql& sql, std::optional<Deadlines::Watch>& watch) {
  if (deadlines_) watch.emplace(*deadlines_, socket_of(sql), SteadyClock::now() + limits_.transaction);
}

void ConnectionPool::give_back(std::unique_ptr<Sql> sql) {
  {
    const std::lock_guard lock(mutex_);
    --in_use_;
    if (sql) idle_.push_back(std::move(sql));
  }
  freed_.notify_one();
}

void ConnectionPool::drop_idle() {
  std::vector<std::unique_ptr<Sql>> lost;
  const std::lock_guard lock(mutex_);
  lost.swap(idle_);
}

}  // namespace ream::store
