#include "score/swept_front.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace ream::score {
namespace {

constexpr double table_reach_mm = 8.0;

shell::ToolProfile front_of(const shell::ToolProfile& tool, double back_mm) {
  shell::ToolProfile front;
  const auto add = [&front](double radius_mm, double z_mm) {
    if (!front.points.empty()) {
      const shell::ProfilePoint& last = front.points.back();
      if (last.radius_mm == radius_mm && last.z_mm == z_mm) return;
      front.roles.push_back(shell::SurfaceRole::cutting);
    }
    front.points.push_back({radius_mm, z_mm});
  };
  double lowest = 0.0;
  for (size_t i = 0; i < tool.roles.size(); ++i) {
    if (tool.roles[i] != shell::SurfaceRole::cutting) continue;
    const shell::ProfilePoint &a = tool.points[i], &b = tool.points[i + 1];
    if (front.points.empty()) {
      lowest = a.z_mm;
      add(0.0, a.z_mm);
    }
    add(a.radius_mm, a.z_mm);
    add(b.radius_mm, b.z_mm);
    lowest = std::min({lowest, a.z_mm, b.z_mm});
  }
  if (front.points.empty()) throw Error(ErrorKind::invalid_input, "the tool has no cutting surface");
  add(front.points.back().radius_mm, lowest - back_mm);
  add(0.0, lowest - back_mm);
  return front;
}

}  // namespace

SweptFront::SweptFront(const shell::ToolProfile& profile, double back_mm)
    : meridian_(front_of(profile, back_mm), table_reach_mm) {}

double SweptFront::distance_mm(const Vec3& tool_mm) const {
  return meridian_.nearest(std::hypot(tool_mm.x(), tool_mm.y()), tool_mm.z()).signed_distance_mm;
}

}  // namespace ream::score
