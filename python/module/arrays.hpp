#pragma once
#include <pybind11/numpy.h>

#include <array>

#include "geometry/pose.hpp"
#include "geometry/triangle_mesh.hpp"
#include "voxel/voxel_grid.hpp"

/// What C++ has, as NumPy arrays, and back.
namespace ream::python {

/// What NumPy is asked for: numbers of that type in rows, made of others where need be.
template <typename Number>
using Numbers = pybind11::array_t<Number, pybind11::array::c_style | pybind11::array::forcecast>;
using Doubles = Numbers<double>;

/// x, y, z.
using Triple = std::array<double, 3>;
inline Vec3 vector(const Triple& t) { return {t[0], t[1], t[2]}; }

/// Bytes that `owner` keeps brick after brick, seen without a copy and for reading only: bricks along z, y,
/// x, then voxels along z, y, x.
pybind11::array bytes_view(const voxel::VoxelGrid& grid, const uint8_t* bytes, pybind11::handle owner);

/// A homogeneous matrix (4, 4).
pybind11::array_t<double> matrix_of(const Pose& pose);

/// Vertices (n, 3) float32, and triangles (m, 3) uint32.
pybind11::tuple mesh_arrays(const TriangleMesh& mesh);
/// Error invalid_input for other shapes.
TriangleMesh mesh_from(const Numbers<float>& vertices, const Numbers<uint32_t>& triangles);

/// Rows of x, y, z in mm, or of these and a quaternion w, x, y, z of any length but zero. Error invalid_input
/// for other shapes, for a place a metre away or not finite, and for a quaternion that is no rotation.
std::vector<Pose> poses_from(const Doubles& rows);

}  // namespace ream::python
