#pragma once
#include <memory>
#include <mutex>
#include <string>

#include "core/periodic_task.hpp"
#include "store/database.hpp"

namespace ream::api {

/// Asks the database every two seconds whether it is there, so that nobody who asks about it waits. A line in
/// the log says when it is lost and when it is back. Thread-safe.
class DatabaseWatch {
 public:
  explicit DatabaseWatch(std::shared_ptr<store::Database> database);

  void start() { task_.start(); }
  void stop() { task_.stop(); }

  /// Throws Error unavailable while the database does not answer. Waits for nothing.
  void require_there() const;

 private:
  /// In words for people; empty while it answers.
  std::string look() const;
  void note(std::string problem);

  const std::shared_ptr<store::Database> database_;
  mutable std::mutex mutex_;
  std::string problem_;
  bool failed_before_ = false;
  PeriodicTask task_;
};

}  // namespace ream::api
