#include "collide/contact_direction.hpp"

#include <cmath>

#include "core/units.hpp"

namespace ream::collide {

std::vector<uint32_t> azimuth_table() {
  std::vector<uint32_t> table(azimuth_count);
  for (uint32_t i = 0; i < azimuth_count; ++i) {
    const double angle = 2.0 * pi * i / azimuth_count;
    const auto coded = [](double x) {
      return static_cast<uint32_t>(std::lround(x * (1 << azimuth_shift))) & 0xffff;
    };
    table[i] = coded(std::cos(angle)) | coded(std::sin(angle)) << 16;
  }
  return table;
}

void add_products(const ContactVector& v, ContactProducts& sums) noexcept {
  size_t k = 0;
  for (size_t i = 0; i < 5; ++i)
    for (size_t j = i; j < 5; ++j) sums[k++] += v.weight * v.g[i] * v.g[j];
  for (size_t i = 0; i < 5; ++i) sums[k++] += v.weight * v.g[i];
  sums[k] += v.weight;
}

}  // namespace ream::collide
