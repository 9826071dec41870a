#include "reader/mesh_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/file.hpp"
#include "geometry/mesh_io.hpp"
#include "support/box_mesh.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::reader {
namespace {

using test::box_mesh;
using test::expect_error;

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

template <typename T>
void put(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string binary_stl(const TriangleMesh& mesh) {
  std::string out(80, ' ');
  put(out, static_cast<uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) put(out, 0.0f);
    for (const uint32_t v : t)
      for (int i = 0; i < 3; ++i) put(out, mesh.vertices_mm[v][i]);
    put(out, uint16_t{0});
  }
  return out;
}

std::string text_stl(const TriangleMesh& mesh) {
  std::string out = "solid box\n";
  for (const auto& t : mesh.triangles) {
    out += "facet normal 0 0 0\nouter loop\n";
    for (const uint32_t v : t) {
      const Vec3f& p = mesh.vertices_mm[v];
      out += "vertex " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) +
             "\n";
    }
    out += "endloop\nendfacet\n";
  }
  return out + "endsolid box\n";
}

std::string obj(const TriangleMesh& mesh) {
  std::string out;
  for (const Vec3f& p : mesh.vertices_mm)
    out += "v " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
  for (const auto& t : mesh.triangles)
    out += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) +
           "\n";
  return out;
}

std::string ply(const TriangleMesh& mesh) {
  const test::TemporaryFolder folder;
  write_ply(folder.path() / "mesh.ply", mesh);
  return read_text_file(folder.path() / "mesh.ply");
}

/// Each triangle as its corner positions, smallest corner first, all sorted: equal for equal surfaces.
std::vector<std::array<float, 9>> surface(const TriangleMesh& mesh) {
  std::vector<std::array<float, 9>> triangles;
  for (const auto& t : mesh.triangles) {
    std::array<std::array<float, 3>, 3> corners;
    for (size_t k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) corners[k][static_cast<size_t>(i)] = mesh.vertices_mm[t[k]][i];
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    std::array<float, 9> flat;
    std::memcpy(flat.data(), corners.data(), sizeof flat);
    triangles.push_back(flat);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

struct Format {
  const char* name;
  const char* file;
  std::string (*write)(const TriangleMesh&);
};

std::ostream& operator<<(std::ostream& out, const Format& format) { return out << format.name; }

class MeshFormat : public testing::TestWithParam<Format> {
 protected:
  TriangleMesh load(const std::string& bytes) const {
    return read_mesh_file(folder_.write(GetParam().file, bytes));
  }
  void expect_refused(const std::string& bytes) const {
    expect_error(ErrorKind::invalid_input, GetParam().file, [&] { load(bytes); });
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_P(MeshFormat, GivesTheSameSurfaceWithJoinedVertices) {
  const TriangleMesh box = box_mesh(3, 4, 5.5f);
  const TriangleMesh loaded = load(GetParam().write(box));
  EXPECT_EQ(loaded.vertices_mm.size(), 8u);
  EXPECT_EQ(surface(loaded), surface(box));
  EXPECT_NEAR(loaded.volume_mm3(), 66.0, 1e-4);
}

TEST_P(MeshFormat, RefusesVerticesThatAreNotFinite) {
  for (const float bad : {not_a_number, infinite, -infinite}) {
    TriangleMesh mesh = box_mesh(3, 4, 5);
    mesh.vertices_mm[5].y() = bad;
    expect_refused(GetParam().write(mesh));
  }
}

TEST_P(MeshFormat, RefusesAFileWithoutTriangles) {
  expect_refused(GetParam().write(TriangleMesh{}));
  expect_refused("");
}

TEST_P(MeshFormat, DropsDegenerateTriangles) {
  TriangleMesh mesh = box_mesh(3, 4, 5);
  mesh.triangles.push_back({1, 1, 2});
  EXPECT_EQ(surface(load(GetParam().write(mesh))), surface(box_mesh(3, 4, 5)));
  mesh.triangles = {{1, 1, 2}};
  expect_refused(GetParam().write(mesh));
}

TEST_P(MeshFormat, RefusesWhatIsNoMesh) { expect_refused("this is not a mesh\n\x01\x02\x03"); }

INSTANTIATE_TEST_SUITE_P(MeshFile, MeshFormat,
                         testing::Values(Format{"binary_stl", "mesh.stl", binary_stl},
                                         Format{"text_stl", "mesh.stl", text_stl},
                                         Format{"obj", "mesh.obj", obj}, Format{"ply", "mesh.ply", ply}),
                         [](const auto& format) { return std::string(format.param.name); });

TEST(MeshFile, RefusesTruncatedBinaryFiles) {
  const test::TemporaryFolder folder;
  const TriangleMesh box = box_mesh(3, 4, 5);
  for (const std::string& bytes : {binary_stl(box), ply(box)}) {
    const char* const name = bytes.starts_with("ply") ? "cut.ply" : "cut.stl";
    for (size_t length = 0; length < bytes.size(); length += 7)
      expect_error(ErrorKind::invalid_input, name,
                   [&] { read_mesh_file(folder.write(name, std::string_view(bytes).substr(0, length))); });
    expect_error(ErrorKind::invalid_input, name, [&] {
      read_mesh_file(folder.write(name, std::string_view(bytes).substr(0, bytes.size() - 1)));
    });
  }
}

TEST(MeshFile, RefusesATruncatedTextStl) {
  const test::TemporaryFolder folder;
  const std::string bytes = text_stl(box_mesh(3, 4, 5));
  for (size_t length = 0; length < bytes.size() - 12; length += 37)
    expect_error(ErrorKind::invalid_input, "cut.stl",
                 [&] { read_mesh_file(folder.write("cut.stl", std::string_view(bytes).substr(0, length))); });
}

TEST(MeshFile, ReadsTextAndBigEndianPlyWithPolygonsAndOtherProperties) {
  const test::TemporaryFolder folder;
  const std::string elements =
      "comment made by hand\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
      "property uchar red\nelement other 1\nproperty list uchar short numbers\nelement face 1\n"
      "property list uchar uint vertex_index\nend_header\n";
  const std::string text = "ply\r\nformat ascii 1.0\r\n" + elements +
                           "0 0 0 255\n2 0 0 0\n2 3 0 9\n0 3 1e-1 1\n3 7 -8 9\n4 0 1 2 3\n";
  std::string big = "ply\nformat binary_big_endian 1.0\n" + elements;
  const auto put_big = [&](auto value) {
    std::string bytes;
    put(bytes, value);
    big.append(bytes.rbegin(), bytes.rend());
  };
  const double positions[4][3] = {{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0.1}};
  for (const auto& p : positions) {
    for (const double c : p) put_big(c);
    put_big(uint8_t{255});
  }
  put_big(uint8_t{1});
  put_big(int16_t{-8});
  put_big(uint8_t{4});
  for (uint32_t i = 0; i < 4; ++i) put_big(i);
  for (const std::string& bytes : {text, big}) {
    const TriangleMesh mesh = read_mesh_file(folder.write("polygon.PLY", bytes));
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.bounds().max, Vec3(2, 3, 0.1f));
    EXPECT_EQ(mesh.vertices_mm[mesh.triangles[1][2]], Vec3f(0, 3, 0.1f));
  }
}

TEST(MeshFile, RefusesPlyHeadersThatMakeNoSense) {
  const test::TemporaryFolder folder;
  const std::string begin = "ply\nformat ascii 1.0\n";
  for (const std::string& bytes :
       {std::string("ply\nformat ascii 1.0\nelement vertex 1"), std::string("ply\nend_header\n"),
        std::string("plx\nformat ascii 1.0\nend_header\n"),
        std::string("ply\nformat morse 1.0\nend_header\n"), begin + "property float x\nend_header\n",
        begin + "element vertex\nend_header\n", begin + "element vertex 1\nproperty half x\nend_header\n1\n",
        begin + "element vertex 99999999999999\nproperty float x\nend_header\n1 2 3\n",
        begin + "element vertex 99999999999999\nend_header\n",
        begin + "element face 1\nproperty list uint int vertex_indices\nend_header\n4000000000 1 2 3\n",
        begin + "element face 1\nproperty list int int vertex_indices\nend_header\n-1\n",
        begin + "element vertex 1\nproperty float x\nend_header\none\n"})
    expect_error(ErrorKind::invalid_input, "odd.ply",
                 [&] { read_mesh_file(folder.write("odd.ply", bytes)); });
}

TEST(MeshFile, RefusesIndicesWithoutVertex) {
  const test::TemporaryFolder folder;
  TriangleMesh mesh = box_mesh(3, 4, 5);
  mesh.triangles.push_back({0, 1, 8});
  for (const Format& format : {Format{"", "mesh.obj", obj}, Format{"", "mesh.ply", ply}})
    expect_error(ErrorKind::invalid_input, format.file,
                 [&] { read_mesh_file(folder.write(format.file, format.write(mesh))); });
}

TEST(MeshFile, RefusesFoldersAndOtherNames) {
  const test::TemporaryFolder folder;
  expect_error(ErrorKind::invalid_input, folder.path().string(), [&] { read_mesh_file(folder.path()); });
  expect_error(ErrorKind::invalid_input, "mesh.unknown",
               [&] { read_mesh_file(folder.write("mesh.unknown", "x")); });
}

TEST(MeshFile, MergesAllParts) {
  const test::TemporaryFolder folder;
  const std::string two =
      "o one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no two\nv 0 0 5\nv 1 0 5\nv 0 1 5\nf 4 5 6\n";
  const TriangleMesh mesh = read_mesh_file(folder.write("two.obj", two));
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.bounds().max, Vec3(1, 1, 5));
}

}  // namespace
}  // namespace ream::reader
