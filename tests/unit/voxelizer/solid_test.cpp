#include <gtest/gtest.h>

#include <queue>

#include "geometry/mesh_io.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"
#include "support/shared_data.hpp"
#include "support/test_meshes.hpp"
#include "voxelizer/voxelizer.hpp"

namespace ream::voxelizer {
namespace {

using test::box_mesh;

Mat3 turned(double a) { return rotation_from_small_vector(Vec3(0.3 * a, -0.5 * a, 0.2 * a)); }

VoxelSet voxelized(const TriangleMesh& mesh, const RasterGrid& grid, const Request& request, int threads = 2,
                   size_t max_dense_bytes = default_dense_bytes) {
  VoxelSet set(grid, max_dense_bytes);
  Voxelizer(threads).voxelize(mesh, request, set);
  return set;
}

Request solid_alone() { return {.surface = false, .solid = true}; }

RasterGrid roomy(const TriangleMesh& mesh, const Vec3& size_mm) {
  RasterGrid grid = grid_around(used_bounds(mesh, 1.0), size_mm);
  grid.origin_mm -= 2.0 * size_mm;
  grid.dims.array() += 4;
  return grid;
}

void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto base = static_cast<uint32_t>(mesh.vertices_mm.size());
  mesh.vertices_mm.insert(mesh.vertices_mm.end(), other.vertices_mm.begin(), other.vertices_mm.end());
  for (const auto& t : other.triangles) mesh.triangles.push_back({base + t[0], base + t[1], base + t[2]});
}

/// Bits of a whole set, a byte a voxel.
std::vector<uint8_t> bytes_of(const VoxelSet& set) {
  std::vector<uint8_t> bytes;
  std::vector<uint32_t> row(set.grid().words_per_row());
  for (int w = 0; w < set.grid().dims.z(); ++w)
    for (int v = 0; v < set.grid().dims.y(); ++v) {
      set.read_row(v, w, row);
      for (int u = 0; u < set.grid().dims.x(); ++u)
        bytes.push_back(static_cast<uint8_t>((row[static_cast<size_t>(u / 32)] >> (u % 32)) & 1u));
    }
  return bytes;
}

/// Unmarked voxels that a walk from voxel (0,0,0) reaches, stepping to face neighbours or to all 26.
std::vector<uint8_t> outside_of(const VoxelSet& set, bool all_neighbours) {
  const std::vector<uint8_t> marked = bytes_of(set);
  const Vec3i dims = set.grid().dims;
  const auto index = [&](const Vec3i& p) {
    return static_cast<size_t>(p.x()) +
           static_cast<size_t>(dims.x()) *
               (static_cast<size_t>(p.y()) + static_cast<size_t>(dims.y()) * static_cast<size_t>(p.z()));
  };
  std::vector<uint8_t> seen(marked.size(), 0);
  std::queue<Vec3i> open;
  open.push(Vec3i::Zero());
  seen[0] = 1;
  while (!open.empty()) {
    const Vec3i voxel = open.front();
    open.pop();
    for (int n = 0; n < 27; ++n) {
      const Vec3i step(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
      if (!all_neighbours && step.cwiseAbs().sum() != 1) continue;
      const Vec3i next = voxel + step;
      if ((next.array() < 0).any() || (next.array() >= dims.array()).any() || seen[index(next)]) continue;
      if (marked[index(next)]) continue;
      seen[index(next)] = 1;
      open.push(next);
    }
  }
  return seen;
}

TEST(Solid, IsTheVoxelsWhoseCentreIsInside) {
  for (int turn = 0; turn < 6; ++turn) {
    const Pose placed{turned(turn), Vec3(1.0, 2.0, 3.0)};
    const Vec3 half(5.1, 3.3, 4.2);
    const TriangleMesh box = box_mesh(half.cast<float>()).transformed(placed);
    const VoxelSet set = voxelized(box, roomy(box, {0.31, 0.23, 0.42}), solid_alone());
    const Pose box_from_grid = placed.inverse();
    for (int w = 0; w < set.grid().dims.z(); ++w)
      for (int v = 0; v < set.grid().dims.y(); ++v)
        for (int u = 0; u < set.grid().dims.x(); ++u) {
          const Vec3 depth = half - box_from_grid.point(set.grid().centre_mm(u, v, w)).cwiseAbs();
          if (std::abs(depth.minCoeff()) < 1e-5) continue;
          ASSERT_EQ(set.marked(u, v, w), depth.minCoeff() > 0.0) << turn << ' ' << u << ' ' << v << ' ' << w;
        }
  }
}

TEST(Solid, LeavesCavitiesEmpty) {
  TriangleMesh shell = box_mesh({5.0f, 5.0f, 5.0f});
  append(shell, box_mesh({3.0f, 3.0f, 3.0f}));
  const VoxelSet set = voxelized(shell, roomy(shell, Vec3::Constant(0.25)), solid_alone());
  EXPECT_EQ(set.filled(), 40u * 40u * 40u - 24u * 24u * 24u);
}

TEST(Solid, VolumesOfMeshesOfOthersAreTheirs) {
  for (const auto& [name, voxels_across] :
       {std::pair{"mesh/reamer_4006.stl", 150.0}, {"mesh/scapula_right_openforge_28106.stl", 150.0}}) {
    REAM_SKIP_WITHOUT(test::shared_data(name));
    const TriangleMesh mesh = load_mesh(test::shared_data(name));
    require_closed(mesh, 1.0);
    const Aabb box = used_bounds(mesh, 1.0);
    const RasterGrid grid = roomy(mesh, Vec3::Constant((box.max - box.min).maxCoeff() / voxels_across));
    const VoxelSet set = voxelized(mesh, grid, solid_alone());
    // Faces that lie along the grid gain or lose up to half a voxel; not in the mean over places of the mesh.
    constexpr int places = 8;
    double volume = 0.0;
    for (int place = 0; place < places; ++place) {
      const Pose moved{Mat3::Identity(), grid.size_mm * (static_cast<double>(place) / places)};
      volume += static_cast<double>(voxelized(mesh.transformed(moved), grid, solid_alone()).filled()) *
                grid.size_mm.prod() / places;
    }
    EXPECT_NEAR(volume / std::abs(mesh.volume_mm3()), 1.0, 0.002) << name;
    // Every voxel that can be reached from outside around the thin surface is outside, all others inside.
    Request thin;
    thin.separability = Separability::six;
    const VoxelSet surface = voxelized(mesh, grid, thin);
    const std::vector<uint8_t> outside = outside_of(surface, false), skin = bytes_of(surface),
                               solid = bytes_of(set);
    for (size_t i = 0; i < solid.size(); ++i)
      if (skin[i] == 0) {
        ASSERT_NE(solid[i], outside[i]) << name << ", voxel " << i;
      }
  }
}

TEST(Surface, ClosedMeshesDoNotLeak) {
  for (const char* name : {"mesh/reamer_4006.stl", "mesh/scapula_right_openforge_28106.stl"}) {
    REAM_SKIP_WITHOUT(test::shared_data(name));
    const TriangleMesh mesh = load_mesh(test::shared_data(name));
    const Aabb box = used_bounds(mesh, 1.0);
    for (const double across : {40.0, 110.0}) {
      const RasterGrid grid = roomy(mesh, Vec3::Constant((box.max - box.min).maxCoeff() / across));
      const std::vector<uint8_t> inside = bytes_of(voxelized(mesh, grid, solid_alone()));
      for (const bool all_neighbours : {false, true}) {
        Request request;
        request.separability = all_neighbours ? Separability::twenty_six : Separability::six;
        const VoxelSet surface = voxelized(mesh, grid, request);
        const std::vector<uint8_t> outside = outside_of(surface, all_neighbours), skin = bytes_of(surface);
        size_t leaks = 0;
        for (size_t i = 0; i < inside.size(); ++i) leaks += inside[i] && !skin[i] && outside[i];
        EXPECT_EQ(leaks, 0u) << name << ' ' << across << (all_neighbours ? " 26" : " 6");
      }
    }
  }
}

TEST(Solid, GridsThatAreSmallerThanTheMeshHoldTheirPart) {
  const TriangleMesh box = box_mesh({50.0f, 50.0f, 50.0f});
  const RasterGrid inside{{33, 20, 10}, {-10.0, -10.0, -10.0}, Vec3::Ones()};
  EXPECT_EQ(voxelized(box, inside, solid_alone()).filled(), 33u * 20u * 10u);
  const RasterGrid across{{40, 20, 10}, {30.0, -10.0, -10.0}, Vec3::Ones()};
  EXPECT_EQ(voxelized(box, across, solid_alone()).filled(), 20u * 20u * 10u);
  const RasterGrid before{{40, 20, 10}, {-60.0, -10.0, -10.0}, Vec3::Ones()};
  EXPECT_EQ(voxelized(box, before, solid_alone()).filled(), 30u * 20u * 10u);
}

TEST(Solid, MeshesThatAreOpenAreRefusedWithThePlace) {
  TriangleMesh open = box_mesh({1.0f, 2.0f, 3.0f});
  require_closed(open, 1.0);
  open.triangles.pop_back();
  test::expect_error(ErrorKind::invalid_input, "3 edges belong to an odd number",
                     [&] { require_closed(open, 1.0); });
}

TEST(VoxelSet, BricksHoldWhatBitsHold) {
  TriangleMesh mesh = box_mesh({9.0f, 7.0f, 8.0f}).transformed({turned(1.0), Vec3::Zero()});
  std::mt19937 random(test::seed(5));
  append(mesh, test::random_triangles(random, 60, 12.0f));
  for (const bool solid : {false, true}) {
    const Request request{.surface = true, .solid = solid};
    const RasterGrid grid = roomy(mesh, {0.13, 0.11, 0.17});
    const VoxelSet bits = voxelized(mesh, grid, request), bricks = voxelized(mesh, grid, request, 2, 0);
    EXPECT_FALSE(bits.sparse());
    EXPECT_TRUE(bricks.sparse());
    EXPECT_EQ(bricks.filled(), bits.filled());
    EXPECT_EQ(bytes_of(bricks), bytes_of(bits));
  }
}

TEST(Voxelizer, ThreadsAndTilesChangeNothing) {
  std::mt19937 random(test::seed(6));
  const TriangleMesh mesh = test::random_triangles(random, 500, 30.0f);
  const RasterGrid grid = roomy(mesh, Vec3::Constant(0.17));
  const VoxelSet one = voxelized(mesh, grid, {}, 1);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(bytes_of(voxelized(mesh, grid, {}, threads)), bytes_of(one));
}

TEST(RasterGrid, ImpossibleRequestsAreRefused) {
  const TriangleMesh box = box_mesh({1.0f, 1.0f, 1.0f});
  const Aabb bounds = used_bounds(box, 1.0);
  for (const double size : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity(), 1e-7, 1e-4})
    EXPECT_THROW(grid_around(bounds, Vec3::Constant(size)), Error) << size;
  EXPECT_THROW(used_bounds(TriangleMesh{}, 1.0), Error);
  for (const double scale : {0.0, -2.0, std::nan("")}) EXPECT_THROW(used_bounds(box, scale), Error) << scale;
  TriangleMesh broken = box;
  broken.triangles[3][1] = 99;
  test::expect_error(ErrorKind::invalid_input, "names vertex 99 of 8", [&] { used_bounds(broken, 1.0); });
  broken = box;
  broken.vertices_mm[2].y() = std::nanf("");
  test::expect_error(ErrorKind::invalid_input, "not a finite number", [&] { used_bounds(broken, 1.0); });
}

TEST(RasterGrid, ScaleAndSizesPerAxisAreTheSameAsScaledMeshes) {
  const TriangleMesh box = box_mesh({1.0f, 2.0f, 3.0f}).transformed({turned(2.0), Vec3(3.0, 2.0, 1.0)});
  TriangleMesh twice = box;
  for (Vec3f& v : twice.vertices_mm) v *= 2.0f;
  const RasterGrid grid = roomy(twice, {0.2, 0.3, 0.1});
  Request scaled;
  scaled.scale = 2.0;
  EXPECT_EQ(bytes_of(voxelized(box, grid, scaled)), bytes_of(voxelized(twice, grid, {})));
}

}  // namespace
}  // namespace ream::voxelizer
