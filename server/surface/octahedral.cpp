#include "surface/octahedral.hpp"

#include <cmath>

namespace ream::surface {
namespace {

/// Folds between the two halves; its own inverse.
void fold(float& x, float& y) {
  const float unfolded_x = x;
  x = std::copysign(1.0f - std::fabs(y), x);
  y = std::copysign(1.0f - std::fabs(unfolded_x), y);
}

int8_t signed_byte(float v) { return static_cast<int8_t>(std::floor(v * 127.0f + 0.5f)); }

}  // namespace

std::array<int8_t, 2> octahedral_from_direction(const Vec3f& direction) {
  const float sum = std::fabs(direction.x()) + std::fabs(direction.y()) + std::fabs(direction.z());
  float x = direction.x() / sum, y = direction.y() / sum;
  if (direction.z() < 0.0f) fold(x, y);
  return {signed_byte(x), signed_byte(y)};
}

Vec3f direction_from_octahedral(int8_t ox, int8_t oy) {
  float x = static_cast<float>(ox) / 127.0f, y = static_cast<float>(oy) / 127.0f;
  const float z = 1.0f - std::fabs(x) - std::fabs(y);
  if (z < 0.0f) fold(x, y);
  return Vec3f(x, y, z).normalized();
}

}  // namespace ream::surface
