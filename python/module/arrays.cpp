#include "module/arrays.hpp"

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "module/computing.hpp"

namespace ream::python {
namespace {

namespace py = pybind11;

/// Of a handle from the planned entry. Poses are kept as whole nanometres in the world, up to 2 m from its
/// origin; no arm reaches as far.
constexpr double max_reach_mm = 1000.0;

template <typename Array>
void require_triples(const Array& array, const char* what) {
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw Error(ErrorKind::invalid_input, std::string(what) + " must have the shape (n, 3)");
}

Mat3 rotation_from(const double* wxyz, py::ssize_t row) {
  const double length =
      std::sqrt(wxyz[0] * wxyz[0] + wxyz[1] * wxyz[1] + wxyz[2] * wxyz[2] + wxyz[3] * wxyz[3]);
  if (!(length > 1e-6) || !std::isfinite(length))
    throw Error(ErrorKind::invalid_input,
                "the quaternion of pose " + std::to_string(row) + " is no rotation");
  return rotation_from_quaternion({wxyz[0] / length, wxyz[1] / length, wxyz[2] / length, wxyz[3] / length});
}

}  // namespace

py::array bytes_view(const voxel::VoxelGrid& grid, const uint8_t* bytes, py::handle owner) {
  const Vec3i bricks = grid.brick_dims();
  constexpr py::ssize_t edge = voxel::brick_edge;
  const std::vector<py::ssize_t> shape{bricks.z(), bricks.y(), bricks.x(), edge, edge, edge};
  std::vector<py::ssize_t> strides(shape.size(), 1);
  for (size_t axis = shape.size() - 1; axis > 0; --axis) strides[axis - 1] = strides[axis] * shape[axis];
  py::array view(py::dtype::of<uint8_t>(), shape, strides, bytes, owner);
  view.attr("flags").attr("writeable") = false;
  return view;
}

py::array_t<double> matrix_of(const Pose& pose) {
  py::array_t<double> matrix({4, 4});
  auto m = matrix.mutable_unchecked<2>();
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      m(row, column) = row == 3 ? (column == 3 ? 1.0 : 0.0)
                                : (column == 3 ? pose.translation_mm[row] : pose.rotation(row, column));
  return matrix;
}

py::tuple mesh_arrays(const TriangleMesh& mesh) {
  py::array_t<float> vertices({static_cast<py::ssize_t>(mesh.vertices_mm.size()), py::ssize_t{3}});
  py::array_t<uint32_t> triangles({static_cast<py::ssize_t>(mesh.triangles.size()), py::ssize_t{3}});
  auto v = vertices.mutable_unchecked<2>();
  auto t = triangles.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < vertices.shape(0); ++i)
    for (int axis = 0; axis < 3; ++axis) v(i, axis) = mesh.vertices_mm[static_cast<size_t>(i)][axis];
  for (py::ssize_t i = 0; i < triangles.shape(0); ++i)
    for (size_t corner = 0; corner < 3; ++corner)
      t(i, static_cast<py::ssize_t>(corner)) = mesh.triangles[static_cast<size_t>(i)][corner];
  return py::make_tuple(vertices, triangles);
}

TriangleMesh mesh_from(const Numbers<float>& vertices, const Numbers<uint32_t>& triangles) {
  require_triples(vertices, "vertices");
  require_triples(triangles, "triangles");
  TriangleMesh mesh;
  const auto v = vertices.unchecked<2>();
  const auto t = triangles.unchecked<2>();
  for (py::ssize_t i = 0; i < v.shape(0); ++i) mesh.vertices_mm.emplace_back(v(i, 0), v(i, 1), v(i, 2));
  for (py::ssize_t i = 0; i < t.shape(0); ++i) mesh.triangles.push_back({t(i, 0), t(i, 1), t(i, 2)});
  return mesh;
}

std::vector<Pose> poses_from(const Doubles& rows) {
  if (rows.ndim() != 2 || (rows.shape(1) != 3 && rows.shape(1) != 7))
    throw Error(ErrorKind::invalid_input,
                "poses must have the shape (n, 3): x, y, z; or (n, 7): x, y, z and a quaternion w, x, y, z");
  const PlainNumbers plain;
  std::vector<Pose> poses(static_cast<size_t>(rows.shape(0)));
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    const double* row = rows.data(i, 0);
    Pose& pose = poses[static_cast<size_t>(i)];
    pose.translation_mm = Vec3(row[0], row[1], row[2]);
    if (!(pose.translation_mm.norm() < max_reach_mm))
      throw Error(ErrorKind::invalid_input, "pose " + std::to_string(i) + " must be less than " +
                                                std::to_string(static_cast<int>(max_reach_mm)) +
                                                " mm from the planned entry, and its numbers finite");
    if (rows.shape(1) == 7) pose.rotation = rotation_from(row + 3, i);
  }
  return poses;
}

}  // namespace ream::python
