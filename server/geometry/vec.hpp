#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

namespace ream {

using Vec3 = Eigen::Vector3d;   ///< mm unless the name says otherwise
using Vec3f = Eigen::Vector3f;  ///< mm, where memory matters (meshes)
using Vec3i = Eigen::Vector3i;  ///< voxel, brick or cell indices
using Mat3 = Eigen::Matrix3d;

}  // namespace ream
