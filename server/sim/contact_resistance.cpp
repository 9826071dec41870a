#include "sim/contact_resistance.hpp"

#include <algorithm>
#include <cmath>

namespace ream::sim {
namespace {

/// Full symmetric matrix of a part's second sums in mm and rad, times `scale`, added to `m`.
void add(force::Mat6& m, const collide::ContactSums::Part& part, double moment_length_mm, double scale) {
  size_t k = 0;
  for (size_t i = 0; i < 6; ++i)
    for (size_t j = i; j < 6; ++j) {
      const double unit = (i < 3 ? 1.0 : moment_length_mm) * (j < 3 ? 1.0 : moment_length_mm);
      const double value = static_cast<double>(part.second[k++]) * unit * scale;
      m[6 * i + j] += value;
      if (i != j) m[6 * j + i] += value;
    }
}

/// Largest of the three translational diagonal sums: n_x^2, n_y^2, n_z^2.
double largest_translational(const collide::ContactSums::Part& part) {
  return static_cast<double>(std::max({part.second[0], part.second[6], part.second[11]}));
}

}  // namespace

force::EngagedBone engaged_bone(const Model& model, const collide::ContactSums& sums) noexcept {
  force::EngagedBone bone;
  int64_t total = 0;
  for (const int64_t n : sums.class_points) total += n;
  if (total == 0) return bone;
  const double spacing_mm = model.settings.tool_spacing_mm;
  bone.area_mm2 =
      static_cast<double>(sums.cutting.first[6]) / shell::area_weights_a_face * spacing_mm * spacing_mm;
  for (size_t k = 0; k < 3; ++k) {
    if (sums.class_points[k] == 0) continue;
    const auto points = static_cast<double>(sums.class_points[k]);
    bone.share[k] = points / static_cast<double>(total);
    bone.density_g_cc[k] =
        k == static_cast<size_t>(voxel::BoneClass::cartilage)
            ? voxel::cartilage_density_g_cc
            : static_cast<double>(sums.class_density[k]) * voxel::density_step_g_cc / points;
  }
  return bone;
}

force::Resistance contact_resistance(const Model& model, const collide::ContactSums& sums,
                                     double resistance_n_s_mm, bool cuts) noexcept {
  force::Resistance resistance;
  const double length = model.contact_shell.moment_length_mm;
  const double axial = largest_translational(sums.cutting);
  if (cuts && axial > 0.0) add(resistance.cutting, sums.cutting, length, resistance_n_s_mm / axial);
  if (!cuts) add(resistance.guiding, sums.cutting, length, 1.0);
  add(resistance.guiding, sums.guiding, length, 1.0);
  // Normals point out of the tool, into the bone; the way out is the other way.
  Vec3 into = Vec3::Zero();
  for (size_t i = 0; i < 3; ++i)
    into[static_cast<Eigen::Index>(i)] = static_cast<double>(sums.cutting.first[i] + sums.guiding.first[i]);
  const double squared = into.squaredNorm();
  if (squared > 0.0) resistance.outward = -into / std::sqrt(squared);
  return resistance;
}

}  // namespace ream::sim
