#pragma once
#include <mutex>
#include <string>
#include <thread>

#include "session/service/session_engine.hpp"

namespace ream::api {

/// Makes the demo case in the background, once, while the server answers already. Thread-safe.
class Readiness {
 public:
  /// Begins at once; ready at once where nothing is to be made.
  Readiness(session::SessionEngine& engine, bool make_demo_case);
  /// Waits for the case.
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
