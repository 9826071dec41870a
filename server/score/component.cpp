#include "score/component.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace ream::score {
namespace {

/// Over this radius the distance of bone from the back is averaged before anything is decided by it: single
/// places of a voxel surface lie up to a tenth of a voxel beside the truth. Steps are kept.
constexpr double averaged_over_mm = 0.6, step_slope = 0.5;

/// How far the component reaches: not quite to the wall that the reamer leaves around it.
double outline_mm(const NativeGlenoid& native) {
  return std::max(0.5 * native.reamer().outer_mm(), native.reamer().outer_mm() - Component::clearance_mm);
}

CuttingMeridian back_of(const NativeGlenoid& native) {
  const double outer_mm = native.reamer().outer_mm();
  const auto& plan = native.task().plan;
  if (plan && plan->implant_radius_mm && *plan->implant_radius_mm > 0.0)
    return CuttingMeridian::sphere(*plan->implant_radius_mm, std::min(outer_mm, *plan->implant_radius_mm));
  return native.reamer();
}

}  // namespace

AchievedRay achieved_ray(const NativeGlenoid& native, const SurfaceFinder& left, size_t ray) {
  AchievedRay now;
  now.surface_mm = left.depth(native.rays(), ray, native.surface_mm()[ray]);
  if (!native.face()[ray]) return now;
  const double before = native.surface_mm()[ray], gone = native.exit_mm()[ray];
  now.removed_mm = std::max(0.0, std::min(now.surface_mm, gone) - before);
  if (now.surface_mm >= gone) now.surface_mm = no_surface_mm;
  if (now.removed_mm == no_surface_mm) now.removed_mm = 0.0;
  return now;
}

AchievedFace achieved_face(const NativeGlenoid& native, const CoverageView& left) {
  const SurfaceFinder finder(left);
  AchievedFace face;
  face.voxel_mm = left.grid.spacing_mm.maxCoeff();
  for (size_t ray = 0; ray < native.rays().size(); ++ray) {
    const AchievedRay now = achieved_ray(native, finder, ray);
    face.surface_mm.push_back(now.surface_mm);
    face.removed_mm.push_back(now.removed_mm);
  }
  return face;
}

/// `behind`: how far the bone there lies beyond the back while the component's apex is at line_.apex_mm.
struct Component::Spot {
  double behind_mm = no_surface_mm;
  double slope_cosine = 1.0;
  double area = 0.0;  ///< across the axis, any unit
};

Component::Component(const NativeGlenoid& native, const AchievedFace& face, const CutLine& line)
    : line_(line),
      outline_mm_(std::min(outline_mm(native), back_of(native).outer_mm())),
      back_(back_of(native)) {
  const RayLattice& rays = native.rays();
  for (size_t ray = 0; ray < rays.size(); ++ray) {
    if (!native.face()[ray]) continue;
    const bool any = face.surface_mm[ray] != no_surface_mm;
    const Vec3 point(rays.x_mm(ray), rays.y_mm(ray), any ? face.surface_mm[ray] : native.surface_mm()[ray]);
    if ((point - line_.apex_mm).cross(line_.direction).norm() <= outline_mm_) footprint_.push_back(ray);
  }
  std::vector<Spot> spots = spots_over(native, face);
  std::vector<double> behind_mm(rays.size(), no_surface_mm);
  for (size_t i = 0; i < spots.size(); ++i) behind_mm[footprint_[i]] = spots[i].behind_mm;
  behind_mm = rays.smoothed(behind_mm, averaged_over_mm, step_slope);
  for (size_t i = 0; i < spots.size(); ++i) spots[i].behind_mm = behind_mm[footprint_[i]];
  seat(spots);
}

Vec3 Component::apex_mm() const { return line_.apex_mm + along_mm_ * line_.direction; }

std::vector<Component::Spot> Component::spots_over(const NativeGlenoid& native,
                                                   const AchievedFace& face) const {
  const RayLattice& rays = native.rays();
  std::vector<Spot> spots;
  spots.reserve(footprint_.size());
  for (const size_t ray : footprint_) {
    const bool any = face.surface_mm[ray] != no_surface_mm;
    const Vec3 point(rays.x_mm(ray), rays.y_mm(ray), any ? face.surface_mm[ray] : native.surface_mm()[ray]);
    const Vec3 offset = point - line_.apex_mm;
    const double depth = offset.dot(line_.direction);
    const Vec3 across = offset - depth * line_.direction;
    const double radius = across.norm();
    Spot spot;
    spot.slope_cosine = back_.slope_cosine(radius);
    if (any) spot.behind_mm = depth + back_.behind_mm(radius);
    // Rays are even across the planned axis; the back is even across its own. The normal of the back points
    // out of the bone: against the axis, and inwards as far as it slopes.
    const double slope_sine = std::sqrt(std::max(0.0, 1.0 - spot.slope_cosine * spot.slope_cosine));
    const Vec3 outwards = radius > 1e-9 ? Vec3(across / radius) : Vec3(Vec3::Zero());
    const Vec3 normal = spot.slope_cosine * line_.direction + slope_sine * outwards;
    spot.area = spot.slope_cosine / std::max(0.1, normal.z());
    spots.push_back(spot);
  }
  return spots;
}

void Component::seat(std::vector<Spot>& spots) {
  std::sort(spots.begin(), spots.end(),
            [](const Spot& a, const Spot& b) { return a.behind_mm < b.behind_mm; });
  double area = 0.0, area_of_bone = 0.0;
  for (const Spot& spot : spots) {
    area += spot.area;
    if (spot.behind_mm != no_surface_mm) area_of_bone += spot.area;
  }
  if (!(area_of_bone > 0.0)) return;
  seated_ = true;
  double sunk = 0.0;
  for (const Spot& spot : spots) {
    along_mm_ = spot.behind_mm;
    sunk += spot.area;
    if (sunk >= sinking_share * area_of_bone) break;
  }
  double supported = 0.0;
  for (const Spot& spot : spots)
    if (spot.behind_mm != no_surface_mm && (spot.behind_mm - along_mm_) * spot.slope_cosine <= contact_mm)
      supported += spot.area;
  supported_share_ = supported / area;
}

}  // namespace ream::score
