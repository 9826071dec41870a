#pragma once

// Vectors are only passed between functions that become one.
#pragma GCC diagnostic ignored "-Wpsabi"

// Vectors of doubles that every form of the program computes alike, with whatever instructions it was
// compiled for.
namespace ream::voxelizer {

using Double4 = double __attribute__((vector_size(32)));
using Double8 = double __attribute__((vector_size(64)));
using Int4 = int __attribute__((vector_size(16)));
using Int8 = int __attribute__((vector_size(32)));
using Long4 = long long __attribute__((vector_size(32)));
using Long8 = long long __attribute__((vector_size(64)));
using Float8 = float __attribute__((vector_size(32)));

/// Whole numbers of as many lanes.
template <class Doubles>
struct WholeOf;
template <>
struct WholeOf<double> {
  using Type = int;
};
template <>
struct WholeOf<Double4> {
  using Type = Int4;
};
template <>
struct WholeOf<Double8> {
  using Type = Int8;
};

template <class T>
inline T smaller(const T& a, const T& b) {
  return a < b ? a : b;
}
template <class T>
inline T larger(const T& a, const T& b) {
  return a > b ? a : b;
}
template <class T>
inline T magnitude(const T& a) {
  return a < 0.0 ? -a : a;
}

inline bool all_below(double a, double limit) { return a < limit; }
inline bool all_below(const Double8& a, double limit) {
  int below = -1;
  const Int8 each = __builtin_convertvector(a < limit, Int8);
  for (int i = 0; i < 8; ++i) below &= each[i];
  return below != 0;
}

/// ceil(x) and floor(x) held within [low, high], exact for every x and so the same whatever the limits.
inline int ceil_between(double x, int low, int high) {
  const double held = smaller(larger(x, static_cast<double>(low)), static_cast<double>(high));
  const int whole = static_cast<int>(held);
  return whole + static_cast<int>(static_cast<double>(whole) < held);
}
inline int floor_between(double x, int low, int high) {
  const double held = smaller(larger(x, static_cast<double>(low)), static_cast<double>(high));
  const int whole = static_cast<int>(held);
  return whole - static_cast<int>(static_cast<double>(whole) > held);
}

/// The first whole number that is not below x, and the last that is not above it, for |x| < 2^50.
inline constexpr double whole_shift = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to whole numbers
inline constexpr long long whole_shift_bits = 0x4338000000000000;
inline Long4 whole_from(const Double4& x) {
  const Double4 shifted = x + whole_shift;
  return (reinterpret_cast<Long4>(shifted) - whole_shift_bits) - (shifted - whole_shift < x);
}
inline Long4 whole_up_to(const Double4& x) {
  const Double4 shifted = x + whole_shift;
  return (reinterpret_cast<Long4>(shifted) - whole_shift_bits) + (shifted - whole_shift > x);
}

/// The same as doubles.
template <class Doubles>
inline Doubles rounded_up(const Doubles& x) {
  const Doubles whole = (x + whole_shift) - whole_shift;
  return whole < x ? whole + 1.0 : whole;
}
template <class Doubles>
inline Doubles rounded_down(const Doubles& x) {
  const Doubles whole = (x + whole_shift) - whole_shift;
  return whole > x ? whole - 1.0 : whole;
}

/// ceil(x) and floor(x) held within [low, high] lane by lane, the limits as doubles that are whole numbers.
template <class Doubles, class Whole = typename WholeOf<Doubles>::Type>
inline Whole ceil_between(const Doubles& x, double low, double high) {
  return __builtin_convertvector(rounded_up(smaller(larger(x, Doubles{} + low), Doubles{} + high)), Whole);
}
template <class Doubles, class Whole = typename WholeOf<Doubles>::Type>
inline Whole floor_between(const Doubles& x, double low, double high) {
  return __builtin_convertvector(rounded_down(smaller(larger(x, Doubles{} + low), Doubles{} + high)), Whole);
}
/// whole_shift more than ceil(x) and floor(x), so that the last bits are the whole number's.
inline Double8 shifted_up(const Double8& x) {
  const Double8 shifted = x + whole_shift;
  return shifted - whole_shift < x ? shifted + 1.0 : shifted;
}
inline Double8 shifted_down(const Double8& x) {
  const Double8 shifted = x + whole_shift;
  return shifted - whole_shift > x ? shifted - 1.0 : shifted;
}
/// 1 << x for whole numbers x from 0 to 63 that are shifted so.
inline Long8 bit_at(const Double8& shifted) {
  return (Long8{} + 1) << (reinterpret_cast<Long8>(shifted) & 63);
}

}  // namespace ream::voxelizer
