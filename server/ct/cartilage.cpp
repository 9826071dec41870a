#include "ct/cartilage.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "ct/articular_face.hpp"

namespace ream::ct {
namespace {

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
