#include "score/wall_thickness.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "score/depth_gauge.hpp"

namespace ream::score {
namespace {

constexpr double farthest_mm = 45.0;
constexpr double thin_percentile = 0.05;
/// Fewer places tell no plane.
constexpr int min_places = 5;

bool was_reamed(const AchievedFace& face, size_t ray) {
  return face.removed_mm[ray] >= reamed_mm && face.surface_mm[ray] != no_surface_mm;
}

/// Columns and rows of the rays within normal_over_mm of one.
std::vector<std::pair<int, int>> around(const RayLattice& rays) {
  std::vector<std::pair<int, int>> places;
  const int most = static_cast<int>(normal_over_mm / rays.spacing_mm());
  for (int row = -most; row <= most; ++row)
    for (int column = -most; column <= most; ++column)
      if (std::hypot(row, column) * rays.spacing_mm() <= normal_over_mm) places.emplace_back(column, row);
  return places;
}

/// Unit normal of what was reamed around a ray, into the bone; frame of the lattice. Along the rays where too
/// little was reamed to tell.
Vec3 normal_at(const RayLattice& rays, const AchievedFace& face, size_t ray,
               const std::vector<std::pair<int, int>>& places) {
  Mat3 squares = Mat3::Zero();
  Vec3 products = Vec3::Zero();
  int count = 0;
  for (const auto& [column, row] : places) {
    const int beside = rays.neighbour(ray, column, row);
    if (beside < 0 || !was_reamed(face, static_cast<size_t>(beside))) continue;
    const Vec3 at(column * rays.spacing_mm(), row * rays.spacing_mm(), 1.0);
    squares += at * at.transpose();
    products += (face.surface_mm[static_cast<size_t>(beside)] - face.surface_mm[ray]) * at;
    ++count;
  }
  if (count < min_places) return Vec3::UnitZ();
  const Eigen::LDLT<Mat3> factors(squares);
  const Vec3 plane = factors.solve(products);
  // Places on one line tell no plane.
  const bool told = factors.vectorD().minCoeff() > 1e-6 && plane.allFinite();
  return told ? Vec3(-plane.x(), -plane.y(), 1.0).normalized() : Vec3(Vec3::UnitZ());
}

/// Along the normal of one ray to where the bone ends.
class WallProbe {
 public:
  WallProbe(const NativeGlenoid& native, const AchievedFace& face, const CoverageView& left)
      : rays_(native.rays()),
        face_(face),
        finder_(left),
        places_(around(rays_)),
        inside_mm_(0.5 * face.voxel_mm) {}

  double thickness_mm(size_t ray) const {
    const Vec3 along = rays_.world_direction(normal_at(rays_, face_, ray, places_));
    const Vec3 from = rays_.world(ray, face_.surface_mm[ray]);
    return finder_.out_of_bone(from, along, inside_mm_, farthest_mm).value_or(no_surface_mm);
  }

 private:
  const RayLattice& rays_;
  const AchievedFace& face_;
  SurfaceFinder finder_;
  std::vector<std::pair<int, int>> places_;
  double inside_mm_;  ///< from the face on, where its own coverage is that of bone
};

}  // namespace

std::vector<double> wall_thickness_mm(const NativeGlenoid& native, const AchievedFace& face,
                                      const CoverageView& left) {
  const WallProbe probe(native, face, left);
  std::vector<double> thickness(native.rays().size(), no_surface_mm);
  for (size_t ray = 0; ray < thickness.size(); ++ray)
    if (was_reamed(face, ray)) thickness[ray] = probe.thickness_mm(ray);
  return thickness;
}

void measure_wall_thickness(const NativeGlenoid& native, const AchievedFace& face, const CoverageView& left,
                            const Component& component, MetricResults& results) {
  const RayLattice& rays = native.rays();
  const WallProbe probe(native, face, left);
  const double within_mm = component.outline_radius_mm() - thin_rim_mm;
  std::vector<double> found;
  for (const size_t ray : component.footprint()) {
    if (!was_reamed(face, ray)) continue;
    const Vec3 at(rays.x_mm(ray), rays.y_mm(ray), face.surface_mm[ray]);
    if ((at - component.apex_mm()).cross(component.axis()).norm() > within_mm) continue;
    const double thickness = probe.thickness_mm(ray);
    if (thickness != no_surface_mm) found.push_back(thickness);
  }
  const char* none = "nothing was reamed under the component's middle, or its bone has no far wall";
  for (const char* key : {"wall_thickness_least_mm", "wall_thickness_thin_mm"})
    results.set_missing(key, none);
  if (found.empty()) return;
  results.set("wall_thickness_least_mm", *std::min_element(found.begin(), found.end()));
  const auto place = static_cast<std::ptrdiff_t>(thin_percentile * static_cast<double>(found.size()));
  std::nth_element(found.begin(), found.begin() + place, found.end());
  results.set("wall_thickness_thin_mm", found[static_cast<size_t>(place)]);
}

}  // namespace ream::score
