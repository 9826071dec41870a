#include "api/readiness.hpp"

#include "core/error.hpp"
#include "core/log.hpp"
#include "core/signal_handlers.hpp"

namespace ream::api {

Readiness::Readiness(session::SessionEngine& engine, bool make_demo_case) {
  if (!make_demo_case) {
    stage_ = Stage::ready;
    return;
  }
  thread_ = start_thread([this, &engine] {
    Stage stage = Stage::ready;
    std::string reason;
    try {
      engine.make_demo_case();
    } catch (const std::exception& failure) {
      stage = Stage::failed;
      reason = failure.what();
      log::error("the server could not be made ready: " + reason);
    } catch (...) {
      stage = Stage::failed;
      log::current_exception("the server could not be made ready");
    }
    const std::lock_guard lock(mutex_);
    stage_ = stage;
    reason_ = std::move(reason);
  });
}

Readiness::~Readiness() {
  if (thread_.joinable()) thread_.join();
}

void Readiness::require_ready() const {
  require_prepared();
  const std::lock_guard lock(mutex_);
  if (stage_ == Stage::failed)
    throw Error(ErrorKind::unavailable, "the server could not be made ready: " + reason_);
}

void Readiness::require_prepared() const {
  const std::lock_guard lock(mutex_);
  if (stage_ == Stage::preparing)
    throw Error(ErrorKind::unavailable,
                "the server is still preparing its demo case; try again in a few seconds");
}

}  // namespace ream::api
