#include "geometry/box.hpp"

#include "geometry/ordered_product.hpp"

namespace ream {

Aabb Aabb::transformed(const Pose& a_from_b) const {
  const Vec3 c = ordered_point(a_from_b, centre());
  const Vec3 h = ordered_product(a_from_b.rotation.cwiseAbs(), half_size());
  return {c - h, c + h};
}

Obb Obb::from(const Aabb& box, const Pose& frame_from_aabb) {
  Obb obb;
  obb.frame_from_box = {frame_from_aabb.rotation, frame_from_aabb.point(box.centre())};
  obb.half_size = box.half_size();
  return obb;
}

}  // namespace ream
