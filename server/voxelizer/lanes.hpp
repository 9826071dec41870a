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
using ULong4 = unsigned long long __attribute__((vector_size(32)));
using ULong8 = unsigned long long __attribute__((vector_size(64)));
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

/// Adding it rounds to whole numbers, for |x| < 2^50, whose bits are then the last ones.
inline constexpr double whole_shift = 6755399441055744.0;  // 1.5 * 2^52
inline constexpr long long whole_shift_bits = 0x4338000000000000;

/// whole_shift more than ceil(x) and floor(x).
template <class Doubles>
inline Doubles shifted_up(const Doubles& x) {
  const Doubles shifted = x + whole_shift;
  return shifted - whole_shift < x ? shifted + 1.0 : shifted;
}
template <class Doubles>
inline Doubles shifted_down(const Doubles& x) {
  const Doubles shifted = x + whole_shift;
  return shifted - whole_shift > x ? shifted - 1.0 : shifted;
}

/// ceil(x) and floor(x), as integers and as doubles.
inline Long4 whole_from(const Double4& x) {
  return reinterpret_cast<Long4>(shifted_up(x)) - whole_shift_bits;
}
inline Long4 whole_up_to(const Double4& x) {
  return reinterpret_cast<Long4>(shifted_down(x)) - whole_shift_bits;
}
template <class Doubles>
inline Doubles rounded_up(const Doubles& x) {
  return shifted_up(x) - whole_shift;
}
template <class Doubles>
inline Doubles rounded_down(const Doubles& x) {
  return shifted_down(x) - whole_shift;
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

/// 1 << x for whole numbers x from 0 to 63 that are shifted so. Unsigned, as bit 63 is one of them.
inline ULong8 bit_at(const Double8& shifted) {
  return (ULong8{} + 1) << (reinterpret_cast<ULong8>(shifted) & 63);
}

}  // namespace ream::voxelizer
