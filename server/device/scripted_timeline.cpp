#include "device/scripted_timeline.hpp"

#include <algorithm>

namespace ream::device {
namespace {

/// Index of the first entry later than t.
template <typename T>
size_t first_after(const std::vector<T>& entries, double t_s) {
  return static_cast<size_t>(std::upper_bound(entries.begin(), entries.end(), t_s,
                                              [](double t, const T& entry) { return t < entry.t_s; }) -
                             entries.begin());
}

}  // namespace

double force_at(const std::vector<TimedForce>& profile, double t_s) noexcept {
  if (profile.empty()) return 0.0;
  const size_t next = first_after(profile, t_s);
  if (next == 0) return profile.front().force_n;
  if (next == profile.size()) return profile.back().force_n;
  const TimedForce &a = profile[next - 1], &b = profile[next];
  return a.force_n + (b.force_n - a.force_n) * ((t_s - a.t_s) / (b.t_s - a.t_s));
}

TimedPose pose_at(const std::vector<TimedPose>& poses, double t_s) noexcept {
  const size_t next = first_after(poses, t_s);
  if (next == 0) return poses.front();
  if (next == poses.size()) return poses.back();
  const TimedPose &a = poses[next - 1], &b = poses[next];
  const double s = (t_s - a.t_s) / (b.t_s - a.t_s);
  return {t_s, a.position_mm + s * (b.position_mm - a.position_mm),
          a.rotation_vector_rad + s * (b.rotation_vector_rad - a.rotation_vector_rad)};
}

TimedButtons buttons_at(const std::vector<TimedButtons>& buttons, double t_s) noexcept {
  const size_t next = first_after(buttons, t_s);
  return next == 0 ? TimedButtons{} : buttons[next - 1];
}

}  // namespace ream::device
