#include "score/swept_front.hpp"

#include <cmath>

#include "shell/swept_body.hpp"

namespace ream::score {
namespace {

constexpr double table_reach_mm = 8.0;

}  // namespace

SweptFront::SweptFront(const shell::ToolProfile& profile, double back_mm)
    : meridian_(shell::swept_body(profile, back_mm), table_reach_mm) {}

double SweptFront::distance_mm(const Vec3& tool_mm) const {
  return meridian_.nearest(std::hypot(tool_mm.x(), tool_mm.y()), tool_mm.z()).signed_distance_mm;
}

}  // namespace ream::score
