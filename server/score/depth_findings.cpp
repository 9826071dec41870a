#include <algorithm>
#include <cmath>

#include "score/reamed_rays.hpp"
#include "score/surface_findings.hpp"

namespace ream::score {
namespace {

/// Of what was reamed, so much must still have bone for its shape to be spoken of.
constexpr double least_share_left = 0.1;

struct Greatest {
  double removed_mm = 0.0, past_subchondral_mm = 0.0;

  void take(double removed, double past_subchondral) {
    removed_mm = std::max(removed_mm, removed);
    past_subchondral_mm = std::max(past_subchondral_mm, past_subchondral);
  }
};

/// Whether a ray and all four beside it meet what is left of the face: along the edge that a cut leaves where
/// it comes out through the wall, the surface is rounded off.
bool is_over_bone(const NativeGlenoid& native, const AchievedFace& face, size_t ray) {
  const auto meets = [&](int i) {
    return i >= 0 && native.face()[static_cast<size_t>(i)] &&
           face.surface_mm[static_cast<size_t>(i)] != no_surface_mm;
  };
  const RayLattice& rays = native.rays();
  return meets(static_cast<int>(ray)) && meets(rays.neighbour(ray, 1, 0)) &&
         meets(rays.neighbour(ray, -1, 0)) && meets(rays.neighbour(ray, 0, 1)) &&
         meets(rays.neighbour(ray, 0, -1));
}

}  // namespace

void say_depths(const NativeGlenoid& native, const AchievedFace& face, Findings& findings) {
  const RayLattice& rays = native.rays();
  // Rays at the edge of a vault that narrows leave the bone sideways; how deep the reamer went is seen where
  // bone is left under it.
  Greatest over_bone, anywhere;
  double sum = 0.0;
  size_t count = 0;
  for (size_t ray = 0; ray < rays.size(); ++ray) {
    const double removed = face.removed_mm[ray];
    if (removed < reamed_mm) continue;
    ++count;
    sum += removed;
    const double past_subchondral = native.surface_mm()[ray] + removed - native.subchondral_mm()[ray];
    anywhere.take(removed, past_subchondral);
    if (is_over_bone(native, face, ray)) over_bone.take(removed, past_subchondral);
  }
  const Greatest& greatest = over_bone.removed_mm > 0.0 ? over_bone : anywhere;
  findings.say("footprint_area_mm2", static_cast<double>(count) * rays.cell_area_mm2());
  findings.say("depth_max_mm", greatest.removed_mm);
  findings.say("medialization_mm", greatest.past_subchondral_mm);
  findings.say("depth_mean_mm", count > 0 ? sum / static_cast<double>(count) : 0.0);
}

void say_congruity(const NativeGlenoid& native, const AchievedFace& face, Findings& findings) {
  std::vector<Vec3> points;
  size_t reamed = 0;
  for (size_t ray = 0; ray < native.rays().size(); ++ray) {
    reamed += face.removed_mm[ray] >= reamed_mm;
    if (is_amid_reamed(native.rays(), face, ray))
      points.emplace_back(native.rays().x_mm(ray), native.rays().y_mm(ray), face.surface_mm[ray]);
  }
  // Slivers at the edge of what is gone would fit a sphere all too well.
  const bool enough = static_cast<double>(points.size()) >= least_share_left * static_cast<double>(reamed);
  const auto sphere = enough ? fit_sphere(points) : std::nullopt;
  const char* too_little = "what was reamed is too small or too flat to fit a sphere to";
  for (const char* key : {"congruity_mm", "fitted_radius_mm"}) findings.leave(key, too_little);
  if (!sphere) return;
  findings.say("congruity_mm", sphere->mean_deviation_mm);
  findings.say("fitted_radius_mm", sphere->radius_mm);
}

void say_plate(const NativeGlenoid& native, const AchievedFace& face, const Component& component,
               Findings& findings) {
  const char* nothing = "the component has no native face under it";
  const SubchondralPlate& plate = native.plate();
  if (component.footprint().empty()) return findings.leave("plate_preserved_percent", nothing);
  size_t preserved = 0;
  for (const size_t ray : component.footprint()) {
    const double top = native.subchondral_mm()[ray];
    const double whole = std::min(plate.thickness_mm[ray], native.exit_mm()[ray] - top);
    const double left = top + whole - std::max(top, native.surface_mm()[ray] + face.removed_mm[ray]);
    preserved += left >= 0.5 * whole;
  }
  findings.say("plate_preserved_percent",
               100.0 * static_cast<double>(preserved) / static_cast<double>(component.footprint().size()));
}

}  // namespace ream::score
