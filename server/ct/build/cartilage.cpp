#include "ct/build/cartilage.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "ct/hu_volume.hpp"
#include "ct/segment/mask.hpp"
#include "voxel/bone_model.hpp"

namespace ream::ct {
namespace {

constexpr double min_step_mm = 0.3, profile_depth_mm = 10.0, solid = 127.5;
constexpr double min_cosine = 0.5736;  // 55 degrees
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

/// The face of a glenoid as a height map: cells `step_mm` wide along superior and anterior, each with how far
/// lateral of the centre its surface lies.
struct ArticularFace {
  double step_mm = 0.0;
  int half_cells = 0;               ///< cells from -half_cells to half_cells either way
  std::vector<double> height_mm;    ///< smoothed; NaN where there is no face
  std::vector<double> cosine;       ///< of the angle between the surface's normal and lateral
  std::vector<double> from_rim_mm;  ///< along the face, 0 outside it

  int across() const { return 2 * half_cells + 1; }
  size_t index(int superior, int anterior) const {
    return static_cast<size_t>((anterior + half_cells) * across() + superior + half_cells);
  }
};

/// How far lateral of the centre's plane the first bone lies on the way medially; NaN without any.
double height_at(const voxel::BoneModel& bone, const Vec3& point_mm, const Vec3& lateral, double step_mm) {
  double before = voxel::coverage_at(bone, point_mm + profile_depth_mm * lateral);
  if (before >= solid) return nowhere;
  for (double height = profile_depth_mm - step_mm; height >= -profile_depth_mm; height -= step_mm) {
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
  constexpr double max_rise = 1.8;  // of a step, a little over the steepest slope
  const auto on_face = [&](int s, int a) {
    return std::hypot(s, a) * face.step_mm <= reach_mm && face.cosine[face.index(s, a)] >= min_cosine;
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
      if (kept[n] || rise > max_rise * face.step_mm) continue;
      kept[n] = 1;
      pending.emplace_back(ns, na);
    }
  }
  // Pits within the face are part of it.
  fill_voids(kept, {face.across(), face.across(), 1});
  for (size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i]) face.height_mm[i] = nowhere;
    face.cosine[i] = std::max(face.cosine[i], min_cosine);
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

/// The sheet of bone around the glenoid's centre, looked at from lateral: cells within `reach_mm` whose
/// surface lies within 10 mm of the centre's plane, connected to the centre over slopes of less than 55
/// degrees. Throws Error invalid_input when there is no bone under the centre.
ArticularFace articular_face(const voxel::BoneModel& bone, const case_::GlenoidFrame& glenoid,
                             double reach_mm) {
  const Pose grid_from_world = bone.grid.world_from_grid.inverse();
  const Vec3 centre = grid_from_world.point(glenoid.centre_mm),
             lateral = grid_from_world.direction(glenoid.lateral),
             superior = grid_from_world.direction(glenoid.superior),
             anterior = grid_from_world.direction(glenoid.anterior);
  ArticularFace face;
  face.step_mm = std::max(min_step_mm, bone.grid.min_spacing_mm());
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

void check(const CartilageSettings& s) {
  const auto within = [](const char* what, double value, double low, double high) {
    if (!(value >= low && value <= high))
      throw Error(ErrorKind::invalid_input, std::string("cartilage: ") + what + " must be from " +
                                                std::to_string(std::lround(low)) + " to " +
                                                std::to_string(std::lround(high)) + " mm");
  };
  within("thickness", s.thickness_mm, 0.0, 6.0);
  within("taper at the rim", s.rim_taper_mm, 0.0, 10.0);
  within("reach", s.reach_mm, 5.0, 40.0);
}

/// The face at a place between its cells: bilinear, weights of cells without face left out.
struct FacePoint {
  double weight = 0.0, height_mm = 0.0, cosine = 0.0, from_rim_mm = 0.0;
};

FacePoint face_at(const ArticularFace& face, double superior_mm, double anterior_mm) {
  const double s = superior_mm / face.step_mm, a = anterior_mm / face.step_mm;
  const int low_s = static_cast<int>(std::floor(s)), low_a = static_cast<int>(std::floor(a));
  FacePoint point;
  if (std::max({std::abs(low_s), std::abs(low_a), std::abs(low_s + 1), std::abs(low_a + 1)}) >
      face.half_cells)
    return point;
  for (int corner = 0; corner < 4; ++corner) {
    const int cs = low_s + (corner & 1), ca = low_a + (corner >> 1);
    const size_t i = face.index(cs, ca);
    if (std::isnan(face.height_mm[i])) continue;
    const double weight = (1.0 - std::abs(s - cs)) * (1.0 - std::abs(a - ca));
    point.weight += weight;
    point.height_mm += weight * face.height_mm[i];
    point.cosine += weight * face.cosine[i];
    point.from_rim_mm += weight * face.from_rim_mm[i];
  }
  if (point.weight <= 0.0) return point;
  point.height_mm /= point.weight;
  point.cosine /= point.weight;
  point.from_rim_mm /= point.weight;
  return point;
}

uint8_t coverage_of(double within_mm, double voxel_mm) {
  return static_cast<uint8_t>(std::clamp(std::floor(255.0 * (0.5 + within_mm / voxel_mm) + 0.5), 0.0, 255.0));
}

}  // namespace

size_t add_cartilage(voxel::BoneModel& bone, const case_::GlenoidFrame& glenoid,
                     const CartilageSettings& settings) {
  check(settings);
  if (settings.thickness_mm == 0.0) return 0;
  const ArticularFace face = articular_face(bone, glenoid, settings.reach_mm);
  const double voxel_mm = bone.grid.min_spacing_mm(), beneath_mm = 2.0 * bone.grid.spacing_mm.maxCoeff();
  const Vec3i dims = bone.grid.dims;
  size_t cartilage = 0;
  for (int w = 0; w < dims.z(); ++w)
    for (int v = 0; v < dims.y(); ++v)
      for (int u = 0; u < dims.x(); ++u) {
        const Vec3 offset =
            bone.grid.world_from_grid.point(bone.grid.centre_mm({u, v, w})) - glenoid.centre_mm;
        const FacePoint at = face_at(face, offset.dot(glenoid.superior), offset.dot(glenoid.anterior));
        if (at.weight <= 0.0) continue;
        const double above_mm = (offset.dot(glenoid.lateral) - at.height_mm) * at.cosine;
        if (above_mm < -beneath_mm || above_mm > settings.thickness_mm + beneath_mm) continue;
        const double taper =
            settings.rim_taper_mm > 0.0 ? std::min(1.0, at.from_rim_mm / settings.rim_taper_mm) : 1.0;
        const uint8_t layer = coverage_of(settings.thickness_mm * taper - above_mm, voxel_mm);
        const size_t i = bone.grid.index(u, v, w);
        if (layer <= bone.coverage[i]) continue;
        const bool was_bone = bone.coverage[i] >= 128;
        if (!was_bone && above_mm < -voxel_mm) continue;
        bone.coverage[i] = layer;
        if (was_bone) continue;
        bone.density.writable()[i] = voxel::cartilage_code;
        cartilage += layer >= 128;
      }
  return cartilage;
}

}  // namespace ream::ct
