#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>

#include "render/snapshot.hpp"

namespace ream::render {

using Mat4f = Eigen::Matrix4f;

/// OpenGL camera coordinates (x right, y up, looking along -z, mm) from world. Throws Error invalid_input
/// when eye and target coincide.
Mat4f camera_from_world(const Camera& camera);

/// Perspective projection that holds depths near_mm..far_mm.
Mat4f clip_from_camera(double vertical_field_of_view_rad, double aspect, double near_mm, double far_mm);

/// Where a point of the world is seen in a picture of that aspect (width over height): shares of its width
/// from the left and of its height from the top. Empty behind the camera.
std::optional<std::array<double, 2>> place_in_picture(const Camera& camera, double aspect,
                                                      const Vec3& world_mm);

}  // namespace ream::render
