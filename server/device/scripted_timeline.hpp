#pragma once
#include "device/script.hpp"

namespace ream::device {

/// Linear between neighbours, constant before the first and after the last entry.
double force_at(const std::vector<TimedForce>& profile, double t_s) noexcept;
TimedPose pose_at(const std::vector<TimedPose>& poses, double t_s) noexcept;
/// The last entry that has begun; spindle on and no pause before the first.
TimedButtons buttons_at(const std::vector<TimedButtons>& buttons, double t_s) noexcept;

}  // namespace ream::device
