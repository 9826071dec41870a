#pragma once
#include "ct/hu_volume.hpp"

namespace ream::ct {

/// From this slice distance or thickness on, a CT is too coarse for a plan.
inline constexpr double thick_slice_mm = 5.0;

/// Warns of thick slices and says what they cost (measured: tests/unit/ct/thick_slices_test.cpp).
/// `thickness_mm` is what the file says of its slices, 0 when it says nothing.
void remark_thickness(HuVolume& volume, double thickness_mm);

/// Warns when the values cannot be HU: eight bits without a sign, or air near 0 and soft tissue near 1000.
void remark_gray_values(HuVolume& volume);

/// True when neighbours along x are far more alike after the two bytes of each value are swapped.
bool looks_byte_swapped(const HuVolume& volume);

}  // namespace ream::ct
