#include "shell/swept_profile.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "shell/meridian.hpp"

namespace ream::shell {
namespace {

constexpr double widest_z_step_mm = 0.0625, widest_r2_step_mm2 = 0.5;
constexpr double z_steps_per_radius = 200, r2_steps_per_radius2 = 400;

/// Largest power of two that is at most `limit`: its inverse is then exact.
double power_of_two_below(double limit) { return std::exp2(std::floor(std::log2(limit))); }

}  // namespace

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

SweptProfile swept_profile(const ToolProfile& profile, double margin_mm) {
  const ToolProfile body = swept_body(profile, rim_backing_mm);
  SweptProfile table;
  table.max_radius_mm = body.max_radius_mm();
  table.body_min_z_mm = body.min_z_mm();
  table.body_max_z_mm = body.max_z_mm();
  table.margin_mm = margin_mm;

  const double radius = table.max_radius_mm;
  const double z_step = power_of_two_below(std::min(widest_z_step_mm, radius / z_steps_per_radius));
  const double r2_step =
      power_of_two_below(std::min(widest_r2_step_mm2, radius * radius / r2_steps_per_radius2));
  const double first_row = std::floor((table.body_min_z_mm - margin_mm) / z_step) - 1.0;
  const double last_row = std::ceil((table.body_max_z_mm + margin_mm) / z_step) + 1.0;
  const double reach = radius + margin_mm;
  table.z_min_mm = static_cast<float>(first_row * z_step);
  table.z_step_mm = static_cast<float>(z_step);
  table.inverse_z_step = static_cast<float>(1.0 / z_step);
  table.r2_step_mm2 = static_cast<float>(r2_step);
  table.inverse_r2_step = static_cast<float>(1.0 / r2_step);
  table.z_count = static_cast<int>(last_row - first_row) + 1;
  table.r2_count = static_cast<int>(std::ceil(reach * reach / r2_step)) + 2;

  const Meridian meridian(body, margin_mm);
  table.distance_mm.reserve(static_cast<size_t>(table.z_count) * static_cast<size_t>(table.r2_count));
  for (int k = 0; k < table.z_count; ++k)
    for (int i = 0; i < table.r2_count; ++i) {
      const double z = (first_row + k) * z_step;
      table.distance_mm.push_back(
          static_cast<float>(meridian.nearest(std::sqrt(i * r2_step), z).signed_distance_mm));
    }
  return table;
}

double swept_distance_mm(const ToolProfile& profile, double radius_mm, double z_mm) {
  return nearest_on_profile(swept_body(profile, rim_backing_mm), radius_mm, z_mm).signed_distance_mm;
}

}  // namespace ream::shell
