#pragma once
#include <array>
#include <cstdint>

#include "geometry/vec.hpp"

namespace ream {

/// Rigid transform. A pose named a_from_b takes coordinates in frame b to coordinates in frame a. Frames:
/// world (LPS of the CT), handle (device stylus), tool (virtual reamer, origin at the apex of its cutting
/// surface, z along the feed axis, into the bone), grid (mm, origin at the minimum corner of voxel (0,0,0),
/// axes along the voxel axes), mesh (a tool file's own coordinates), device (the haptic device's base).
struct Pose {
  Mat3 rotation = Mat3::Identity();  ///< orthonormal, right-handed
  Vec3 translation_mm = Vec3::Zero();

  Vec3 point(const Vec3& p) const { return rotation * p + translation_mm; }
  Vec3 direction(const Vec3& d) const { return rotation * d; }
  Pose inverse() const;
  bool operator==(const Pose&) const = default;
};

/// a_from_c = a_from_b * b_from_c.
Pose operator*(const Pose& a_from_b, const Pose& b_from_c);

/// Rotation by the rotation vector `v` (axis times angle, rad) by the Cayley map: exact to third order,
/// always orthonormal, and only + - x / so that it is the same on every machine. |v| should stay below 1 rad.
Mat3 rotation_from_small_vector(const Vec3& v);

/// The rotation vector (rad) whose Cayley rotation is `r`; inverse of rotation_from_small_vector for angles <
/// pi.
Vec3 small_vector_from_rotation(const Mat3& r);

/// The turn from `a` to `b` (columns in one frame) as a rotation vector in a's frame, as
/// small_vector_from_rotation gives it but never longer than pi: near half a turn that vector grows beyond
/// all bounds, and half a turn has none.
Vec3 turn_between(const Mat3& a, const Mat3& b);

/// Gram-Schmidt clean-up of a rotation that has drifted by rounding.
Mat3 orthonormalized(const Mat3& r);

/// A rotation whose z axis is `direction` (any length but zero), chosen the same way for the same direction.
Mat3 rotation_with_z_along(const Vec3& direction);

/// Unit quaternion (w, x, y, z) of a rotation, w >= 0, and back; for files and the wire.
std::array<double, 4> quaternion_from_rotation(const Mat3& r);
Mat3 rotation_from_quaternion(const std::array<double, 4>& wxyz);

/// grid_from_tool as it is decided upon and recorded: what removal and contact see is exactly this, on every
/// machine. Rotation row-major in units of 2^-30, translation in nm (range +-2.1 m).
struct QuantisedPose {
  std::array<int32_t, 9> rotation_q30{};
  std::array<int32_t, 3> translation_nm{};
  bool operator==(const QuantisedPose&) const = default;
};

QuantisedPose quantised(const Pose& pose);
Pose dequantised(const QuantisedPose& pose);

}  // namespace ream
