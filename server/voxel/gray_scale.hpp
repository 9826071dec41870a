#pragma once
#include <cstdint>

namespace ream::voxel {

/// Gray values kept in 16 bits: value = offset + step * code.
struct GrayScale {
  double offset = 0.0, step = 1.0;
  bool exact = true;  ///< false: values were rounded to the nearest of 65,536 between least and greatest

  double value(double code) const { return offset + step * code; }
  /// Nearest code; values beyond the scale get its ends, not-a-number gets 0.
  uint16_t code(double value) const;
  bool operator==(const GrayScale&) const = default;
};

/// Finds the scale that keeps all values of a volume: exactly, where they are whole numbers, or have up to
/// four decimals, and span no more than 65,536 steps; else in 65,536 even steps.
class GrayScaleFinder {
 public:
  /// Finite.
  void add(float value);
  void add(const GrayScaleFinder& other);
  /// Of what was added; of nothing, the codes themselves.
  GrayScale scale() const;

 private:
  double least_ = 0.0, greatest_ = -1.0;
  int decimals_ = 0;  ///< 5: more than four
  double power_ = 1.0;
};

}  // namespace ream::voxel
