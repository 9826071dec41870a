#include "shell/swept_body.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace ream::shell {

ToolProfile swept_body(const ToolProfile& profile, double back_mm) {
  ToolProfile body;
  const auto add = [&body](double radius_mm, double z_mm) {
    if (!body.points.empty()) {
      const ProfilePoint& last = body.points.back();
      if (last.radius_mm == radius_mm && last.z_mm == z_mm) return;
      body.roles.push_back(SurfaceRole::cutting);
    }
    body.points.push_back({radius_mm, z_mm});
  };
  double lowest = 0.0;
  for (size_t i = 0; i < profile.roles.size(); ++i) {
    if (profile.roles[i] != SurfaceRole::cutting) continue;
    const ProfilePoint &a = profile.points[i], &b = profile.points[i + 1];
    if (body.points.empty()) {
      lowest = a.z_mm;
      add(0.0, a.z_mm);
    }
    add(a.radius_mm, a.z_mm);
    add(b.radius_mm, b.z_mm);
    lowest = std::min({lowest, a.z_mm, b.z_mm});
  }
  if (body.points.empty()) throw Error(ErrorKind::invalid_input, "the tool has no cutting surface");
  add(body.points.back().radius_mm, lowest - back_mm);
  add(0.0, lowest - back_mm);
  return body;
}

}  // namespace ream::shell
