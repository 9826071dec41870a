#pragma once
#include "ct/phantom/phantom.hpp"
#include "ct/phantom/phantom_shape.hpp"
#include "ct/segment/shoulder_bones.hpp"

namespace ream::ct {

/// A whole phantom shoulder at voxels that are quick to work on.
inline PhantomParams shoulder_params(case_::Side side, double joint_space_mm = 4.0, double noise_hu = 15.0) {
  PhantomParams params;
  params.side = side;
  params.joint_space_mm = joint_space_mm;
  params.noise_hu = noise_hu;
  params.spacing_mm = Vec3(1.0, 1.0, 1.25);
  return params;
}

/// BoneLabel of every voxel's centre, from the phantom's formulas: scapula and humerus.
inline std::vector<uint8_t> true_labels(const HuVolume& volume, PhantomParams params) {
  const double mirror = params.side == case_::Side::left ? -1.0 : 1.0;
  params.side = case_::Side::right;
  const PhantomShape shape(params);
  std::vector<uint8_t> labels;
  labels.reserve(volume.voxel_count());
  for (int w = 0; w < volume.dims.z(); ++w)
    for (int v = 0; v < volume.dims.y(); ++v)
      for (int u = 0; u < volume.dims.x(); ++u) {
        Vec3 p = volume.world_of_centre({u, v, w});
        p.x() *= mirror;
        labels.push_back(shape.scapula_mm(p) < 0.0 ? 1 : shape.humerus_mm(p) < 0.0 ? 2 : 0);
      }
  return labels;
}

/// Voxels that have `ours` in one and `theirs` in the other.
inline size_t count_both(const std::vector<uint8_t>& a, int ours, const std::vector<uint8_t>& b, int theirs) {
  size_t count = 0;
  for (size_t i = 0; i < a.size(); ++i) count += a[i] == ours && b[i] == theirs;
  return count;
}

/// Dice's coefficient of one label in two label maps.
inline double dice(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b, int label) {
  size_t both = 0, sum = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    both += a[i] == label && b[i] == label;
    sum += static_cast<size_t>(a[i] == label) + static_cast<size_t>(b[i] == label);
  }
  return 2.0 * static_cast<double>(both) / static_cast<double>(sum);
}

}  // namespace ream::ct
