#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <memory>
#include <optional>

#include "core/error.hpp"
#include "geometry/mesh_io.hpp"
#include "module/arrays.hpp"
#include "module/bindings.hpp"
#include "module/computing.hpp"
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

}  // namespace

void bind_meshes(py::module_& module) {
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
