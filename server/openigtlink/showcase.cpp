#include "openigtlink/showcase.hpp"

#include <utility>

namespace ream::openigtlink {

void Showcase::show(std::shared_ptr<const ShownSession> session) {
  const std::lock_guard lock(mutex_);
  shown_ = std::move(session);
}

std::shared_ptr<const ShownSession> Showcase::shown() const {
  const std::lock_guard lock(mutex_);
  return shown_;
}

}  // namespace ream::openigtlink
