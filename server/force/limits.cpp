#include "force/limits.hpp"

namespace ream::force {

Vec3 limited(const Vec3& v, double limit) noexcept {
  const double length = v.norm();
  return length > limit ? Vec3(v * (limit / length)) : v;
}

}  // namespace ream::force
