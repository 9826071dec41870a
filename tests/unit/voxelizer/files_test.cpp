#include <gtest/gtest.h>

#include <cstring>

#include "core/file.hpp"

#include <Eigen/Geometry>

#include "geometry/mesh_io.hpp"
#include "geometry/morton.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_meshes.hpp"
#include "voxelizer/voxel_files.hpp"

namespace ream::voxelizer {
namespace {

class VoxelFiles : public testing::Test {
 protected:
  VoxelFiles() {
    mesh = test::box_mesh({3.0f, 2.0f, 4.0f})
               .transformed({rotation_from_small_vector(Vec3(0.2, -0.4, 0.3)), Vec3(10.0, 20.0, -5.0)});
    grid = grid_around(used_bounds(mesh, 1.0), {0.3, 0.2, 0.25});
  }
  VoxelSet voxelized(const Request& request, size_t max_dense_bytes = default_dense_bytes) const {
    VoxelSet set(grid, max_dense_bytes);
    Voxelizer(1).voxelize(mesh, request, set);
    return set;
  }
  /// What `write` puts into a file.
  template <class Write>
  std::string written(Write write) {
    const auto path = folder.path() / "file";
    AtomicFile file(path);
    write(file);
    file.commit();
    return read_text_file(path);
  }
  static std::string body_of(const std::string& text, const std::string& end_of_header) {
    return text.substr(text.find(end_of_header) + end_of_header.size());
  }

  test::TemporaryFolder folder;
  TriangleMesh mesh;
  RasterGrid grid;
};

TEST_F(VoxelFiles, GridsOfBytesAndBitsReadBackAsGridsLikeThem) {
  const VoxelSet set = voxelized({});
  for (const GridFormat format : {GridFormat::bytes, GridFormat::bits}) {
    const std::string text = written([&](AtomicFile& file) { write_nrrd(set, format, file, no_progress); });
    const RasterGrid like = grid_of_nrrd(folder.path() / "file");
    EXPECT_EQ(like.dims, grid.dims);
    EXPECT_LT((like.origin_mm - grid.origin_mm).norm(), 1e-12);
    EXPECT_LT((like.size_mm - grid.size_mm).norm(), 1e-12);
    const std::string body = body_of(text, "\n\n");
    const auto dims_x = static_cast<size_t>(grid.dims.x());
    const size_t row_bytes = format == GridFormat::bits ? (dims_x + 7) / 8 : dims_x;
    ASSERT_EQ(body.size(), row_bytes * grid.rows());
    for (int w = 0; w < grid.dims.z(); ++w)
      for (int v = 0; v < grid.dims.y(); ++v)
        for (int u = 0; u < grid.dims.x(); ++u) {
          const char* row = body.data() + row_bytes * static_cast<size_t>(v + grid.dims.y() * w);
          const int value = format == GridFormat::bits ? (row[u / 8] >> (u % 8)) & 1 : row[u];
          ASSERT_EQ(value, set.marked(u, v, w));
        }
  }
}

TEST_F(VoxelFiles, GridsThatCannotBeTakenAreRefusedByName) {
  const auto refused = [&](const std::string& why, const std::string& text) {
    write_file_atomically(folder.path() / "odd.nrrd", text);
    test::expect_error(ErrorKind::invalid_input, why, [&] { grid_of_nrrd(folder.path() / "odd.nrrd"); });
  };
  const std::string start = "NRRD0004\ndimension: 3\nsizes: 4 5 6\n";
  refused("does not begin", "P5 4 4");
  refused("space directions", start + "space directions: (1,0,0) none (0,0,1)\n\n");
  refused("do not run along", start + "space directions: (0,1,0) (1,0,0) (0,0,1)\n\n");
  refused("do not run along", start + "space directions: (-1,0,0) (0,1,0) (0,0,1)\n\n");
  refused("right-anterior-superior", start + "space: right-anterior-superior\nspacings: 1 1 1\n\n");
  refused("spacings", start + "\n");
  refused("whole number", "NRRD0004\ndimension: 3\nsizes: 4 0 6\nspacings: 1 1 1\n\n");
  refused("positive", start + "spacings: 1 -1 1\n\n");
  test::expect_error(ErrorKind::not_found, "nowhere", [&] { grid_of_nrrd(folder.path() / "nowhere"); });
}

TEST_F(VoxelFiles, MortonCodesRiseAndNameTheMarkedVoxels) {
  for (const size_t max_dense_bytes : {default_dense_bytes, size_t{0}}) {
    const VoxelSet set = voxelized({}, max_dense_bytes);
    const std::string text = written([&](AtomicFile& file) { write_morton_codes(set, file, no_progress); });
    const std::string body = body_of(text, "\n\n");
    ASSERT_EQ(body.size(), 8 * set.filled());
    std::vector<uint64_t> codes(set.filled());
    std::memcpy(codes.data(), body.data(), body.size());
    for (size_t i = 0; i < codes.size(); ++i) {
      if (i > 0) {
        ASSERT_LT(codes[i - 1], codes[i]);
      }
      ASSERT_TRUE(set.marked(static_cast<int>(gather_bits(codes[i])),
                             static_cast<int>(gather_bits(codes[i] >> 1)),
                             static_cast<int>(gather_bits(codes[i] >> 2))));
    }
  }
}

struct Point {
  float x, y, z, nx, ny, nz, area_mm2;
};

TEST_F(VoxelFiles, PointsCarryTheSurface) {
  double area = 0.0;
  for (const auto& t : mesh.triangles)
    area += 0.5 * (mesh.vertices_mm[t[1]] - mesh.vertices_mm[t[0]])
                      .cross(mesh.vertices_mm[t[2]] - mesh.vertices_mm[t[0]])
                      .norm();
  for (const Separability separability : {Separability::six, Separability::twenty_six}) {
    Request request;
    request.separability = separability;
    const VoxelSet set = voxelized(request);
    const std::string text =
        written([&](AtomicFile& file) { write_points(mesh, request, set, file, no_progress); });
    const std::string body = body_of(text, "end_header\n");
    ASSERT_EQ(body.size(), sizeof(Point) * set.filled());
    std::vector<Point> points(set.filled());
    std::memcpy(points.data(), body.data(), body.size());
    double sum = 0.0;
    size_t outward = 0;
    for (const Point& p : points) {
      const Vec3f normal(p.nx, p.ny, p.nz), from_middle = Vec3f(p.x, p.y, p.z) - Vec3f(10.0f, 20.0f, -5.0f);
      EXPECT_NEAR(normal.norm(), 1.0, 1e-5);
      outward += normal.dot(from_middle) > 0.0f;
      sum += static_cast<double>(p.area_mm2);
    }
    EXPECT_EQ(outward, points.size());
    // What lies in the voxels of a supercover is all of it; columns double at edges.
    EXPECT_NEAR(sum / area, 1.0, separability == Separability::six ? 0.1 : 1e-5);
  }
}

TEST_F(VoxelFiles, BoxesCloseAroundTheirVoxels) {
  const Request request{.surface = false, .solid = true};
  const VoxelSet set = voxelized(request);
  written([&](AtomicFile& file) { write_boxes(set, file, no_progress); });
  std::filesystem::rename(folder.path() / "file", folder.path() / "boxes.ply");
  const TriangleMesh boxes = load_mesh(folder.path() / "boxes.ply");
  EXPECT_NEAR(boxes.volume_mm3() / (static_cast<double>(set.filled()) * grid.size_mm.prod()), 1.0, 1e-4);
}

TEST_F(VoxelFiles, FilesThatAreNotFinishedLeaveNothing) {
  const auto path = folder.path() / "kept";
  write_file_atomically(path, "old");
  {
    AtomicFile file(path);
    file.write("new and long");
  }
  EXPECT_EQ(read_text_file(path), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  test::expect_error(ErrorKind::io, "no/where", [&] { AtomicFile(folder.path() / "no/where"); });
}

}  // namespace
}  // namespace ream::voxelizer
