#pragma once
#include "geometry/pose.hpp"

namespace ream {

/// Axis-aligned box in one frame; empty until something is included.
struct Aabb {
  Vec3 min = Vec3::Constant(1e300);
  Vec3 max = Vec3::Constant(-1e300);

  bool empty() const { return (min.array() > max.array()).any(); }
  void include(const Vec3& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
  Vec3 centre() const { return 0.5 * (min + max); }
  Vec3 half_size() const { return 0.5 * (max - min); }
  /// One of the eight; bit k of `number` takes the maximum along axis k.
  Vec3 corner(int number) const {
    return {number & 1 ? max.x() : min.x(), number & 2 ? max.y() : min.y(), number & 4 ? max.z() : min.z()};
  }
  Aabb grown(double by) const { return {min.array() - by, max.array() + by}; }
  bool contains(const Vec3& p) const {
    return (p.array() >= min.array()).all() && (p.array() <= max.array()).all();
  }
  /// Common part of both; empty when they do not meet.
  Aabb intersection(const Aabb& other) const { return {min.cwiseMax(other.min), max.cwiseMin(other.max)}; }
  /// Box in frame a around this box of frame b.
  Aabb transformed(const Pose& a_from_b) const;
};

/// Oriented box: centred at `frame_from_box`'s origin, half sizes along its axes.
struct Obb {
  Pose frame_from_box;
  Vec3 half_size = Vec3::Zero();

  static Obb from(const Aabb& box, const Pose& frame_from_aabb);
};

}  // namespace ream
