#pragma once
#include <string>

#include "geometry/vec.hpp"

namespace ream::ct {

/// "x,y,z" with one decimal each, for messages.
inline std::string text_of_point(const Vec3& p) {
  const auto one = [](double v) {
    const std::string s = std::to_string(v);
    return s.substr(0, s.find('.') + 2);
  };
  return one(p.x()) + "," + one(p.y()) + "," + one(p.z());
}

}  // namespace ream::ct
