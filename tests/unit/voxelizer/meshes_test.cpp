#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "bench/voxelize/benchmark_meshes.hpp"
#include "support/separating_axis.hpp"
#include "support/shared_data.hpp"
#include "voxelizer/voxelizer.hpp"

namespace ream::voxelizer {
namespace {

/// What the issue allows, voxels.
constexpr double max_gap = 1e-5;

/// What an independent test in doubles says of every voxel: those that some triangle touches, and those that
/// some triangle is at most `max_gap` away from.
struct Reference {
  std::vector<bool> touched, allowed;

  Reference(const TriangleMesh& mesh, const RasterGrid& grid)
      : touched(static_cast<size_t>(grid.voxels())), allowed(static_cast<size_t>(grid.voxels())) {
    for (const auto& indices : mesh.triangles) {
      std::array<Vec3, 3> corners;
      for (size_t i = 0; i < 3; ++i)
        corners[i] =
            (mesh.vertices_mm[indices[i]].cast<double>() - grid.origin_mm).cwiseQuotient(grid.size_mm);
      add(corners, grid.dims);
    }
  }

  void add(const std::array<Vec3, 3>& corners, const Vec3i& dims) {
    const test::TriangleAxes axes(corners);
    const Vec3 least = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
    const Vec3 most = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
    const Vec3i low = (least.array() - 1.5).floor().cast<int>().max(0).matrix();
    const Vec3i high = (most.array() + 0.5).floor().cast<int>().min(dims.array() - 1).matrix();
    for (int w = low.z(); w <= high.z(); ++w)
      for (int v = low.y(); v <= high.y(); ++v)
        for (int u = low.x(); u <= high.x(); ++u) {
          const double gap = axes.gap({u + 0.5, v + 0.5, w + 0.5}, max_gap);
          const size_t voxel = index(dims, u, v, w);
          if (gap <= 0.0) touched[voxel] = true;
          if (gap <= max_gap) allowed[voxel] = true;
        }
  }

  static size_t index(const Vec3i& dims, int u, int v, int w) {
    return static_cast<size_t>(u) +
           static_cast<size_t>(dims.x()) *
               (static_cast<size_t>(v) + static_cast<size_t>(dims.y()) * static_cast<size_t>(w));
  }
};

TEST(MeshesOfOthers, MarkTheirSupercover) {
  for (const bench::BenchmarkMesh& which : bench::benchmark_meshes()) {
    const std::optional<TriangleMesh> mesh = bench::load_benchmark_mesh(which);
    if (!mesh) GTEST_SKIP() << "without " << which.file;
    const RasterGrid grid = grid_around(used_bounds(*mesh, 1.0), Vec3::Constant(which.longest_mm / 150.0));
    VoxelSet thick(grid), thin(grid);
    Voxelizer voxelizer;
    Request request;
    voxelizer.voxelize(*mesh, request, thick);
    request.separability = Separability::six;
    voxelizer.voxelize(*mesh, request, thin);
    const Reference reference(*mesh, grid);
    size_t missed = 0, added = 0, outside_thick = 0;
    std::vector<uint32_t> thick_row(grid.words_per_row()), thin_row(grid.words_per_row());
    for (int w = 0; w < grid.dims.z(); ++w)
      for (int v = 0; v < grid.dims.y(); ++v) {
        thick.read_row(v, w, thick_row);
        thin.read_row(v, w, thin_row);
        for (size_t i = 0; i < thick_row.size(); ++i) outside_thick += (thin_row[i] & ~thick_row[i]) != 0;
        for (int u = 0; u < grid.dims.x(); ++u) {
          const bool marked = ((thick_row[static_cast<size_t>(u / 32)] >> (u % 32)) & 1u) != 0;
          const size_t voxel = Reference::index(grid.dims, u, v, w);
          missed += !marked && reference.touched[voxel];
          added += marked && !reference.allowed[voxel];
        }
      }
    const auto touched = std::count(reference.touched.begin(), reference.touched.end(), true);
    std::cout << which.name << ": " << touched << " voxels touched, " << thick.filled() << " marked, thin "
              << thin.filled() << '\n';
    EXPECT_GT(touched, 1000) << which.name;
    EXPECT_GT(thin.filled(), 1000u) << which.name;
    EXPECT_LT(thin.filled(), thick.filled()) << which.name;
    EXPECT_EQ(missed, 0u) << which.name;
    EXPECT_EQ(added, 0u) << which.name;
    EXPECT_EQ(outside_thick, 0u) << which.name;
  }
}

}  // namespace
}  // namespace ream::voxelizer
