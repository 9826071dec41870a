#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string_view>

#include "core/error.hpp"
#include "geometry/mesh_io.hpp"
#include "module/arrays.hpp"
#include "module/bindings.hpp"
#include "module/computing.hpp"
#include "stream/codec.hpp"
#include "voxelizer/voxelizer.hpp"

namespace ream::python {
namespace {

namespace py = pybind11;
using voxelizer::RasterGrid;
using voxelizer::VoxelSet;

/// Larger ones belong into files: `ream voxelize` writes them.
constexpr double max_array_voxels = 4e9;

/// (z, y, x), one bool a voxel.
py::array_t<bool> array_of(const VoxelSet& set) {
  const Vec3i dims = set.grid().dims;
  py::array_t<bool> marked({py::ssize_t{dims.z()}, py::ssize_t{dims.y()}, py::ssize_t{dims.x()}});
  bool* next = marked.mutable_data();
  std::vector<uint32_t> row(set.grid().words_per_row());
  for (int w = 0; w < dims.z(); ++w)
    for (int v = 0; v < dims.y(); ++v, next += dims.x()) {
      const bool any = set.read_row(v, w, row);
      for (int u = 0; u < dims.x(); ++u)
        next[u] = any && (row[static_cast<size_t>(u) / 32] >> (u % 32) & 1u) != 0;
    }
  return marked;
}

VoxelSet marked_voxels(const TriangleMesh& mesh, const voxelizer::Request& request, const Vec3& size_mm,
                       const std::optional<Triple>& origin_mm, const Progress& progress) {
  const Aabb box = voxelizer::used_bounds(mesh, request.scale);
  const RasterGrid grid = origin_mm ? voxelizer::grid_from(vector(*origin_mm), box, size_mm)
                                    : voxelizer::grid_around(box, size_mm);
  if (grid.voxels() > max_array_voxels)
    throw Error(ErrorKind::invalid_input,
                "more than 4e9 voxels do not go into an array; choose larger voxels, or "
                "write a file with `ream voxelize`");
  voxelizer::check_reach(grid, box);
  if (request.solid) voxelizer::require_closed(mesh, request.scale);
  VoxelSet set(grid);
  voxelizer::Voxelizer().voxelize(mesh, request, set, progress);
  return set;
}

std::vector<std::byte> bytes_of(const py::bytes& bytes) {
  const auto view = static_cast<std::string_view>(bytes);
  const auto* begin = reinterpret_cast<const std::byte*>(view.data());
  return {begin, begin + view.size()};
}

/// Positions (n, 3) in 1/1024 voxel from the block's first corner minus one voxel, normals (n, 3) in the grid
/// frame, triangles (m, 3): of the streams of one MeshBlock.
py::tuple block_surface(const py::bytes& vertices, size_t vertex_count, const py::bytes& indices,
                        size_t index_count) {
  stream::EncodedBlock block;
  // Far more than one block can hold; memory is not taken at a message's word.
  constexpr size_t max_count = size_t{1} << 24;
  if (vertex_count > max_count || index_count > max_count || index_count % 3 != 0)
    throw Error(ErrorKind::invalid_input, "a block of the stream cannot have that many vertices or indices");
  block.vertex_count = static_cast<uint32_t>(vertex_count);
  block.index_count = static_cast<uint32_t>(index_count);
  block.vertices = bytes_of(vertices);
  block.indices = bytes_of(indices);
  const surface::BlockMesh mesh = stream::decode(block);
  const auto rows = static_cast<py::ssize_t>(mesh.vertices.size());
  py::array_t<uint16_t> positions({rows, py::ssize_t{3}});
  py::array_t<float> normals({rows, py::ssize_t{3}});
  uint16_t* position = positions.mutable_data();
  float* normal = normals.mutable_data();
  for (const surface::BlockVertex& v : mesh.vertices) {
    for (const uint16_t units : {v.x, v.y, v.z}) *position++ = units;
    const Vec3f direction = surface::direction_from_octahedral(v.ox, v.oy);
    for (int axis = 0; axis < 3; ++axis) *normal++ = direction[axis];
  }
  py::array_t<uint32_t> triangles({static_cast<py::ssize_t>(mesh.indices.size() / 3), py::ssize_t{3}});
  std::copy(mesh.indices.begin(), mesh.indices.end(), triangles.mutable_data());
  return py::make_tuple(positions, normals, triangles);
}

}  // namespace

void bind_meshes(py::module_& module) {
  module.def("block_surface", &block_surface);
  module.def("load_mesh", [](const std::filesystem::path& path) {
    TriangleMesh mesh;
    {
      const Computing computing;
      mesh = load_mesh(path);
    }
    return mesh_arrays(mesh);
  });
  module.def("voxelize", [](const Numbers<float>& vertices, const Numbers<uint32_t>& triangles,
                            const Triple& size_mm, const std::optional<Triple>& origin_mm, bool solid,
                            bool surface, bool thin) {
    const TriangleMesh mesh = mesh_from(vertices, triangles);
    voxelizer::Request request;
    request.solid = solid;
    request.surface = surface;
    request.separability = thin ? voxelizer::Separability::six : voxelizer::Separability::twenty_six;
    const VoxelSet set = [&] {
      Computing computing;
      Signals signals(computing);
      return marked_voxels(mesh, request, vector(size_mm), origin_mm, signals.progress());
    }();
    const Vec3& origin = set.grid().origin_mm;
    return py::make_tuple(array_of(set), py::make_tuple(origin.x(), origin.y(), origin.z()));
  });
}

}  // namespace ream::python
