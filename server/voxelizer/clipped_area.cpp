#include "voxelizer/clipped_area.hpp"

#include <array>

namespace ream::voxelizer {
namespace {

/// A triangle cut by six planes has nine corners at most.
struct Polygon {
  std::array<Vec3, 10> corners;
  size_t count = 0;
};

/// What of the polygon lies where side * (p[axis] - at) >= 0.
Polygon cut(const Polygon& polygon, int axis, double at, double side) {
  Polygon result;
  for (size_t i = 0; i < polygon.count; ++i) {
    const Vec3& p = polygon.corners[i];
    const Vec3& q = polygon.corners[i + 1 == polygon.count ? 0 : i + 1];
    const double dp = side * (p[axis] - at), dq = side * (q[axis] - at);
    if (dp >= 0.0) result.corners[result.count++] = p;
    if ((dp >= 0.0) != (dq >= 0.0)) {
      Vec3 crossing = p + dp / (dp - dq) * (q - p);
      crossing[axis] = at;
      result.corners[result.count++] = crossing;
    }
  }
  return result;
}

Vec3 twice_area(const Vec3* corners, size_t count) {
  Vec3 sum = Vec3::Zero();
  for (size_t i = 2; i < count; ++i) sum += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
  return sum;
}

}  // namespace

double share_in_voxel(const Vec3 corners[3], const Vec3& low) {
  Polygon polygon;
  for (size_t i = 0; i < 3; ++i) polygon.corners[i] = corners[i];
  polygon.count = 3;
  const Vec3 whole = twice_area(corners, 3);
  const double scale = whole.squaredNorm();
  if (!(scale > 0.0)) return 0.0;
  for (int axis = 0; axis < 3 && polygon.count > 2; ++axis) {
    polygon = cut(polygon, axis, low[axis], 1.0);
    polygon = cut(polygon, axis, low[axis] + 1.0, -1.0);
  }
  return polygon.count < 3 ? 0.0 : twice_area(polygon.corners.data(), polygon.count).dot(whole) / scale;
}

}  // namespace ream::voxelizer
