#include "ct/articular_face.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "ct/segment.hpp"
#include "ct/world_text.hpp"
#include "voxel/coverage_at.hpp"

namespace ream::ct {
namespace {

constexpr double least_step_mm = 0.3, depth_mm = 10.0, solid = 127.5;
constexpr double least_cosine = 0.5736;  // 55 degrees
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

/// How far lateral of the centre's plane the first bone lies on the way medially; NaN without any.
double height_at(const voxel::BoneModel& bone, const Vec3& point_mm, const Vec3& lateral, double step_mm) {
  double before = voxel::coverage_at(bone, point_mm + depth_mm * lateral);
  if (before >= solid) return nowhere;
  for (double height = depth_mm - step_mm; height >= -depth_mm; height -= step_mm) {
    const double here = voxel::coverage_at(bone, point_mm + height * lateral);
    if (here >= solid) return height + step_mm * (here - solid) / (here - before);
    before = here;
  }
  return nowhere;
}

/// A plane through the heights around a cell: its height there and the cosine of its tilt.
struct Tilt {
  double height_mm = nowhere, cosine = 0.0;
};

Tilt tilt_at(const ArticularFace& face, const std::vector<double>& heights, int s, int a) {
  constexpr double around_mm = 1.2, same_sheet_mm = 2.5;
  const double here = heights[face.index(s, a)];
  if (std::isnan(here)) return {};
  const int reach = static_cast<int>(std::ceil(around_mm / face.step_mm));
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (int da = -reach; da <= reach; ++da)
    for (int ds = -reach; ds <= reach; ++ds) {
      if (std::max(std::abs(s + ds), std::abs(a + da)) > face.half_cells) continue;
      const double height = heights[face.index(s + ds, a + da)];
      if (!(std::abs(height - here) <= same_sheet_mm)) continue;
      const Vec3 row(1.0, ds * face.step_mm, da * face.step_mm);
      normal += row * row.transpose();
      right += row * height;
    }
  if (!(std::abs(normal.determinant()) > 1e-9)) return {};
  const Vec3 plane = normal.inverse() * right;
  return {plane[0], 1.0 / std::sqrt(1.0 + plane[1] * plane[1] + plane[2] * plane[2])};
}

/// Keeps the cells that belong to the centre's sheet; false when the centre has none.
bool keep_sheet(ArticularFace& face, double reach_mm) {
  constexpr double greatest_rise = 1.8;  // of a step, a little over the steepest slope
  const auto on_face = [&](int s, int a) {
    return std::hypot(s, a) * face.step_mm <= reach_mm && face.cosine[face.index(s, a)] >= least_cosine;
  };
  Mask kept(face.height_mm.size());
  std::vector<std::pair<int, int>> pending;
  if (on_face(0, 0)) pending.emplace_back(0, 0), kept[face.index(0, 0)] = 1;
  for (size_t k = 0; k < pending.size(); ++k) {
    const auto [s, a] = pending[k];
    for (const auto& [ds, da] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const int ns = s + ds, na = a + da;
      if (std::max(std::abs(ns), std::abs(na)) > face.half_cells || !on_face(ns, na)) continue;
      const size_t n = face.index(ns, na);
      const double rise = std::abs(face.height_mm[n] - face.height_mm[face.index(s, a)]);
      if (kept[n] || rise > greatest_rise * face.step_mm) continue;
      kept[n] = 1;
      pending.emplace_back(ns, na);
    }
  }
  // Pits within the face are part of it.
  fill_voids(kept, {face.across(), face.across(), 1});
  for (size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i]) face.height_mm[i] = nowhere;
    face.cosine[i] = std::max(face.cosine[i], least_cosine);
  }
  return !pending.empty();
}

/// Distance along the height map to the nearest cell that is not of the face.
void measure_rim(ArticularFace& face) {
  std::vector<std::pair<int, int>> rim;
  const auto is_face = [&](int s, int a) {
    return std::max(std::abs(s), std::abs(a)) <= face.half_cells &&
           !std::isnan(face.height_mm[face.index(s, a)]);
  };
  const int n = face.half_cells + 1;
  for (int a = -n; a <= n; ++a)
    for (int s = -n; s <= n; ++s)
      if (!is_face(s, a) &&
          (is_face(s - 1, a) || is_face(s + 1, a) || is_face(s, a - 1) || is_face(s, a + 1)))
        rim.emplace_back(s, a);
  face.from_rim_mm.assign(face.height_mm.size(), 0.0);
  for (int a = -face.half_cells; a <= face.half_cells; ++a)
    for (int s = -face.half_cells; s <= face.half_cells; ++s) {
      if (!is_face(s, a)) continue;
      double least = std::numeric_limits<double>::infinity();
      for (const auto& [rs, ra] : rim) least = std::min(least, std::hypot(rs - s, ra - a));
      face.from_rim_mm[face.index(s, a)] = least * face.step_mm;
    }
}

}  // namespace

ArticularFace articular_face(const voxel::BoneModel& bone, const case_::GlenoidFrame& glenoid,
                             double reach_mm) {
  const Pose grid_from_world = bone.grid.world_from_grid.inverse();
  const Vec3 centre = grid_from_world.point(glenoid.centre_mm),
             lateral = grid_from_world.direction(glenoid.lateral),
             superior = grid_from_world.direction(glenoid.superior),
             anterior = grid_from_world.direction(glenoid.anterior);
  ArticularFace face;
  face.step_mm = std::max(least_step_mm, bone.grid.min_spacing_mm());
  face.half_cells = static_cast<int>(std::ceil(reach_mm / face.step_mm)) + 1;
  const size_t cells = static_cast<size_t>(face.across()) * static_cast<size_t>(face.across());
  std::vector<double> heights(cells);
  for (int a = -face.half_cells; a <= face.half_cells; ++a)
    for (int s = -face.half_cells; s <= face.half_cells; ++s)
      heights[face.index(s, a)] = height_at(bone, centre + face.step_mm * (s * superior + a * anterior),
                                            lateral, 0.5 * bone.grid.min_spacing_mm());
  face.height_mm.resize(cells);
  face.cosine.resize(cells);
  for (int a = -face.half_cells; a <= face.half_cells; ++a)
    for (int s = -face.half_cells; s <= face.half_cells; ++s) {
      const Tilt tilt = tilt_at(face, heights, s, a);
      face.height_mm[face.index(s, a)] = tilt.height_mm;
      face.cosine[face.index(s, a)] = tilt.cosine;
    }
  if (!keep_sheet(face, reach_mm))
    throw Error(ErrorKind::invalid_input, "no articular face within 10 mm of the glenoid's centre " +
                                              text_of_point(glenoid.centre_mm) +
                                              " mm; check the landmarks and the region of interest");
  measure_rim(face);
  return face;
}

}  // namespace ream::ct
