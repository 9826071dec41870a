#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace ream::collide {

/// What an engaged point adds to the sums, before its weight: unit normal n in 1/127 and the x and y of its
/// moment arm (r x n) / moment length in 1/127. The arm has no z: a normal of the swept envelope, a surface
/// of revolution, meets the axis.
struct ContactVector {
  std::array<int32_t, 5> g{};
  int32_t weight = 0;  ///< area in 1/16 cell face, 16 to 28
};

/// Direction codes: the meridian entry (normal and arm in the half plane through the axis) above ten bits of
/// angle about the axis. Two small tables and integer products give the vector on every device.
inline constexpr int azimuth_bits = 10;
inline constexpr uint32_t azimuth_count = 1u << azimuth_bits;
inline constexpr uint32_t most_meridian_entries = 2048;
inline constexpr int azimuth_shift = 14;

struct DirectionTable {
  /// A byte each, lowest first: radial and axial normal, arm about the tangent (signed), weight.
  std::vector<uint32_t> meridian;
  /// cos, then sin in the high half, signed, in 2^-14.
  std::vector<uint32_t> azimuth;

  ContactVector vector(uint32_t direction) const noexcept;
};

/// A meridian entry packed.
constexpr uint32_t meridian_entry(int normal_radial, int normal_z, int arm, int weight) {
  return (static_cast<uint32_t>(normal_radial) & 0xff) | (static_cast<uint32_t>(normal_z) & 0xff) << 8 |
         (static_cast<uint32_t>(arm) & 0xff) << 16 | static_cast<uint32_t>(weight) << 24;
}

/// The azimuth half of the table.
std::vector<uint32_t> azimuth_table();

/// Sums over points of w g_i g_j (upper triangle of 5 x 5, row by row), then w g_i, then w. A block's stay
/// within 32 bits: 512 points of weight 28 and components 127.
using ContactProducts = std::array<int32_t, 21>;
void add_products(const ContactVector& v, ContactProducts& sums) noexcept;

inline ContactVector DirectionTable::vector(uint32_t direction) const noexcept {
  const uint32_t m = meridian[direction >> azimuth_bits], a = azimuth[direction & (azimuth_count - 1)];
  const auto signed_byte = [m](int shift) { return static_cast<int32_t>(static_cast<int8_t>(m >> shift)); };
  const int32_t radial = signed_byte(0), axial = signed_byte(8), arm = signed_byte(16);
  const int32_t cosine = static_cast<int16_t>(a), sine = static_cast<int16_t>(a >> 16);
  const auto turned = [](int32_t product) { return (product + (1 << (azimuth_shift - 1))) >> azimuth_shift; };
  return {{turned(radial * cosine), turned(radial * sine), axial, turned(arm * sine), turned(-arm * cosine)},
          static_cast<int32_t>(m >> 24)};
}

}  // namespace ream::collide
