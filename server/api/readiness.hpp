#pragma once
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace ream::api {

/// What must be made before the first session (the demo case, say), done once in the background while the
/// server answers already. Thread-safe.
class Readiness {
 public:
  /// Begins at once; an empty function is ready at once.
  explicit Readiness(std::function<void()> prepare);
  /// Waits for the preparation.
  ~Readiness();
  Readiness(const Readiness&) = delete;
  Readiness& operator=(const Readiness&) = delete;

  /// Throws Error unavailable until everything is made, and for good when making it failed (with the reason).
  void require_ready() const;
  /// Throws Error unavailable only while it is being made: what does not need it may work all the same.
  void require_prepared() const;

 private:
  enum class Stage { preparing, ready, failed };

  mutable std::mutex mutex_;
  Stage stage_ = Stage::preparing;
  std::string reason_;
  std::thread thread_;
};

}  // namespace ream::api
