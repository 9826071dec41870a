#include "voxel/gray_scale.hpp"

#include <algorithm>
#include <cmath>

namespace ream::voxel {
namespace {

constexpr double last_code = 65535.0;
constexpr int max_decimals = 4;
constexpr double float_error = 1.2e-7;  ///< relative, of a decimal number kept as a float

bool whole(double v) { return std::abs(v - std::nearbyint(v)) <= float_error * std::abs(v); }

}  // namespace

uint16_t GrayScale::code(double v) const {
  const double c = std::floor((v - offset) / step + 0.5);
  return c >= last_code ? uint16_t{65535} : c > 0.0 ? static_cast<uint16_t>(c) : uint16_t{0};
}

void GrayScaleFinder::add(float value) {
  const double v = value;
  if (greatest_ < least_) {
    least_ = greatest_ = v;
  } else {
    least_ = std::min(least_, v);
    greatest_ = std::max(greatest_, v);
  }
  while (decimals_ <= max_decimals && !whole(v * power_)) {
    ++decimals_;
    power_ *= 10.0;
  }
}

void GrayScaleFinder::add(const GrayScaleFinder& other) {
  if (other.greatest_ < other.least_) return;
  if (greatest_ < least_) {
    *this = other;
    return;
  }
  least_ = std::min(least_, other.least_);
  greatest_ = std::max(greatest_, other.greatest_);
  decimals_ = std::max(decimals_, other.decimals_);
  power_ = std::max(power_, other.power_);
}

GrayScale GrayScaleFinder::scale() const {
  if (greatest_ < least_) return {};
  const double steps = (greatest_ - least_) * power_;
  if (decimals_ > max_decimals || steps > last_code)
    return {least_, std::max((greatest_ - least_) / last_code, 1e-12), false};
  const bool from_zero = least_ >= 0.0 && greatest_ * power_ <= last_code;
  return {from_zero ? 0.0 : std::nearbyint(least_ * power_) / power_, 1.0 / power_, true};
}

}  // namespace ream::voxel
