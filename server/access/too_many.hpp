#pragma once
#include "core/error.hpp"

namespace ream::access {

/// Asked too often or by too many at once: try again after a while (HTTP 429).
class TooMany : public Error {
 public:
  TooMany(const std::string& message, int retry_after_s)
      : Error(ErrorKind::unavailable, message), retry_after_s_(retry_after_s) {}
  int retry_after_s() const { return retry_after_s_; }

 private:
  int retry_after_s_;
};

}  // namespace ream::access
