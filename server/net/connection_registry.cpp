#include "net/connection_registry.hpp"

namespace ream::net {

ConnectionRegistry::Place ConnectionRegistry::make_room(const std::string& address, const Limits& limits) {
  std::shared_ptr<Connection> evicted;
  {
    const std::lock_guard lock(mutex_);
    size_t here = 0, of_address = 0;
    for (const auto& [connection, entry] : connections_) {
      if (entry.leaving) continue;
      ++here;
      if (connection->address() == address) ++of_address;
    }
    const bool address_full = !address.empty() && of_address >= limits.connections_per_address;
    if (!address_full && here < limits.connections) return Place::free;
    evicted = longest_waiting(address_full ? address : std::string());
    if (!evicted) return connections_.size() < 2 * limits.connections ? Place::busy : Place::overfull;
    connections_.at(evicted.get()).leaving = true;
  }
  evicted->shut_down();
  return Place::free;
}

std::shared_ptr<Connection> ConnectionRegistry::longest_waiting(const std::string& address) {
  std::shared_ptr<Connection> found;
  Connection::Wait wait = Connection::Wait::nothing;
  Connection::Clock::time_point since;
  for (const auto& [connection, entry] : connections_) {
    const Connection::Wait its_wait = connection->wait();
    if (entry.leaving || its_wait == Connection::Wait::nothing || its_wait < wait) continue;
    if (!address.empty() && connection->address() != address) continue;
    if (found && its_wait == wait && connection->waits_since() >= since) continue;
    if (auto alive = entry.connection.lock()) {
      found = std::move(alive);
      wait = its_wait;
      since = found->waits_since();
    }
  }
  return found;
}

bool ConnectionRegistry::add(const std::shared_ptr<Connection>& connection, bool leaving) {
  const std::lock_guard lock(mutex_);
  if (closed_) return false;
  connections_[connection.get()] = {connection, leaving};
  return true;
}

void ConnectionRegistry::remove(Connection* connection) {
  {
    const std::lock_guard lock(mutex_);
    connections_.erase(connection);
  }
  changed_.notify_all();
}

size_t ConnectionRegistry::size() const {
  const std::lock_guard lock(mutex_);
  return connections_.size();
}

std::vector<std::shared_ptr<Connection>> ConnectionRegistry::all() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<Connection>> list;
  for (const auto& [key, entry] : connections_)
    if (auto connection = entry.connection.lock()) list.push_back(std::move(connection));
  return list;
}

void ConnectionRegistry::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
}

bool ConnectionRegistry::wait_until_empty(std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, timeout, [this] { return connections_.empty(); });
}

}  // namespace ream::net
