#include "collide/decay_shell.hpp"

#include <algorithm>

namespace ream::collide {
namespace {

DecayRun run_of(const DecayShell& shell, uint32_t first, uint32_t count) {
  const auto point = [&](uint32_t i) { return Vec3f(shell.x_mm[i], shell.y_mm[i], shell.z_mm[i]); };
  Vec3f low = point(first), high = low;
  for (uint32_t i = first; i < first + count; ++i) {
    low = low.cwiseMin(point(i));
    high = high.cwiseMax(point(i));
  }
  DecayRun run{first, count, 0.5f * (low + high), 0.0f};
  for (uint32_t i = first; i < first + count; ++i)
    run.radius_mm = std::max(run.radius_mm, (point(i) - run.centre_mm).norm());
  return run;
}

}  // namespace

DecayShell make_decay_shell(const shell::PointShell& shell) {
  DecayShell out;
  for (const shell::ShellPoint& p : shell.points) {
    if (p.role != shell::SurfaceRole::cutting) continue;
    const Vec3 at = shell.surface_point_mm(p);
    out.x_mm.push_back(static_cast<float>(at.x()));
    out.y_mm.push_back(static_cast<float>(at.y()));
    out.z_mm.push_back(static_cast<float>(at.z()));
  }
  const auto size = static_cast<uint32_t>(out.size());
  for (uint32_t first = 0; first < size; first += decay_run_points)
    out.runs.push_back(run_of(out, first, std::min(decay_run_points, size - first)));
  return out;
}

}  // namespace ream::collide
