#include <gtest/gtest.h>

#include <set>

#include "support/expect_error.hpp"
#include "unit/fe/read_inp.hpp"
#include "unit/fe/small_models.hpp"

namespace ream::fe::test {
namespace {

using ream::test::expect_error;

MeshOptions everything() {
  MeshOptions options;
  options.keep_islands = true;
  return options;
}

TEST(Mesh, AThousandVoxelsHaveAsManyNodesAsACubeHasCorners) {
  MeshReport report;
  const ReadInp mesh(inp_of(model_of({10, 10, 10}, [](int, int, int) { return 7; }), {}, {}, &report));
  EXPECT_EQ(report.elements, 1000u);
  EXPECT_EQ(report.nodes, 1331u);
  EXPECT_EQ(mesh.nodes.size(), 1331u);
  EXPECT_DOUBLE_EQ(report.volume_mm3, 125.0);
}

TEST(Mesh, OneElementIsNumberedAsInTheThesisFigure) {
  const ReadInp mesh(inp_of(model_of({1, 1, 1}, [](int, int, int) { return 7; })));
  ASSERT_EQ(mesh.elements.size(), 1u);
  const std::array<std::array<double, 3>, 8> corners{
      {{0, 0, 0}, {.5, 0, 0}, {.5, .5, 0}, {0, .5, 0}, {0, 0, .5}, {.5, 0, .5}, {.5, .5, .5}, {0, .5, .5}}};
  for (size_t k = 0; k < 8; ++k) EXPECT_EQ(mesh.nodes.at(mesh.elements.at(1)[k]), corners[k]) << k;
}

/// Every voxel is one element at its place, every corner one node, on grids around the size of a word.
TEST(Mesh, ElementsAreTheFilledVoxelsAndNodesTheirCorners) {
  uint64_t seed = 1;
  for (const Vec3i& dims : {Vec3i(1, 1, 1), Vec3i(5, 4, 3), Vec3i(63, 3, 4), Vec3i(64, 5, 2), Vec3i(65, 2, 6),
                            Vec3i(130, 7, 3), Vec3i(2, 70, 3)})
    for (const double fill : {0.1, 0.5, 1.0}) {
      SCOPED_TRACE(testing::Message() << dims.transpose() << " fill " << fill << " seed " << seed);
      const RandomGray gray(dims, fill, seed++);
      std::set<std::array<int, 3>> voxels, corners;
      for (int w = 0; w < dims.z(); ++w)
        for (int v = 0; v < dims.y(); ++v)
          for (int u = 0; u < dims.x(); ++u) {
            if (gray(u, v, w) < 0) continue;
            voxels.insert({u, v, w});
            for (int k = 0; k < 8; ++k) corners.insert({u + (k & 1), v + (k >> 1 & 1), w + (k >> 2)});
          }
      if (voxels.empty()) continue;
      const ReadInp mesh(inp_of(model_of(dims, gray), everything()));
      ASSERT_EQ(mesh.elements.size(), voxels.size());
      ASSERT_EQ(mesh.nodes.size(), corners.size());
      EXPECT_EQ(mesh.nodes.begin()->first, 1);
      EXPECT_EQ(mesh.nodes.rbegin()->first, static_cast<long>(corners.size()));
      std::map<long, double> modulus;
      for (const auto& [set, e] : mesh.modulus_of_set)
        for (const long id : mesh.sets.at(set)) EXPECT_TRUE(modulus.emplace(id, e).second) << id;
      for (const auto& [id, nodes] : mesh.elements) {
        const auto& low = mesh.nodes.at(nodes[0]);
        const std::array<int, 3> voxel{static_cast<int>(low[0] * 2), static_cast<int>(low[1] * 2),
                                       static_cast<int>(low[2] * 2)};
        EXPECT_EQ(voxels.erase(voxel), 1u);
        EXPECT_DOUBLE_EQ(modulus.at(id), gray(voxel[0], voxel[1], voxel[2]));
        constexpr int offsets[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                       {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
        for (size_t k = 0; k < 8; ++k)
          for (size_t axis = 0; axis < 3; ++axis)
            EXPECT_DOUBLE_EQ(mesh.nodes.at(nodes[k])[axis], low[axis] + 0.5 * offsets[k][axis]);
      }
      EXPECT_TRUE(voxels.empty());
    }
}

TEST(Mesh, FacesHoldTheNodesOfTheBoundingPlanes) {
  const RandomGray gray({9, 8, 7}, 0.4, 5);
  MeshOptions options = everything();
  options.inp.faces = true;
  const ReadInp mesh(inp_of(model_of({9, 8, 7}, gray), options));
  std::array<double, 3> least{1e9, 1e9, 1e9}, greatest{-1e9, -1e9, -1e9};
  for (const auto& [id, at] : mesh.nodes)
    for (size_t k = 0; k < 3; ++k) {
      least[k] = std::min(least[k], at[k]);
      greatest[k] = std::max(greatest[k], at[k]);
    }
  for (size_t face = 0; face < 6; ++face) {
    std::vector<long> expected;
    for (const auto& [id, at] : mesh.nodes)
      if (at[face / 2] == (face % 2 == 0 ? least : greatest)[face / 2]) expected.push_back(id);
    EXPECT_EQ(mesh.sets.at(face_names[face]), expected) << face_names[face];
  }
}

TEST(Mesh, CoordinatesKeepTheVoxelSize) {
  ElementModel model = model_of({3, 2, 2}, [](int, int, int) { return 7; });
  model.spacing_mm = {0.0195, 0.17578125, 1.0 / 3.0};
  model.origin_mm = {-12.25, 100.0, -0.5};
  const ReadInp mesh(inp_of(std::move(model)));
  EXPECT_DOUBLE_EQ(mesh.nodes.at(1)[0], -12.25);
  EXPECT_DOUBLE_EQ(mesh.nodes.at(4)[0], -12.25 + 3 * 0.0195);
  EXPECT_DOUBLE_EQ(mesh.nodes.at(5)[1], 100.17578125);
  EXPECT_NEAR(mesh.nodes.rbegin()->second[2], -0.5 + 2.0 / 3.0, 1e-6);
}

TEST(Mesh, NothingIsWrittenOfWhatCannotBeMeshed) {
  const ream::test::TemporaryFolder folder;
  const auto make = [&](int gray, const MeshOptions& options) {
    MemoryBudget budget;
    make_mesh(model_of({2, 2, 2}, [&](int, int, int) { return gray; }), options, budget,
              folder.path() / "m.inp");
  };
  expect_error(ErrorKind::invalid_input, "no voxel is bone", [&] { make(-1, {}); });
  MeshOptions negative;
  negative.rule.law = linear_law(-5.0, 1.0);
  expect_error(ErrorKind::invalid_input, "gray value 5", [&] { make(5, negative); });
  MeshOptions stiff;
  stiff.rule.poisson = 0.5;
  expect_error(ErrorKind::usage, "0.5", [&] { make(5, stiff); });
  expect_error(ErrorKind::cancelled, "enough", [&] {
    MemoryBudget budget;
    int calls = 0;
    make_mesh(model_of({2, 2, 40}, [](int, int, int) { return 5; }), {}, budget, folder.path() / "m.inp",
              [&](double share, std::string_view) {
                if (share >= 0.5 && ++calls > 1) throw Error(ErrorKind::cancelled, "enough");
              });
  });
  EXPECT_TRUE(folder.entries().empty());
}

}  // namespace
}  // namespace ream::fe::test
