#include "net/engine.hpp"

namespace ream::net {

bool ConnectionRegistry::add(const std::shared_ptr<Connection>& connection) {
  const std::lock_guard lock(mutex_);
  if (closed_) return false;
  connections_[connection.get()] = connection;
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
  for (const auto& [key, weak] : connections_)
    if (auto connection = weak.lock()) list.push_back(std::move(connection));
  return list;
}

void ConnectionRegistry::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
}

bool ConnectionRegistry::wait_until_empty(std::chrono::milliseconds longest) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, longest, [this] { return connections_.empty(); });
}

}  // namespace ream::net
