#include "geometry/mesh_io.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "core/file.hpp"
#include "core/json.hpp"
#include "support/box_mesh.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream {
namespace {

using test::box_mesh;
using test::expect_error;

std::string ply(const TriangleMesh& mesh) {
  const test::TemporaryFolder folder;
  write_ply(folder.path() / "mesh.ply", mesh);
  return read_text_file(folder.path() / "mesh.ply");
}

/// A GLB file of `copies` nodes, each the same `triangles` triangles. They are of 4 bytes each in the file.
std::string glb_of_copies(int copies, int triangles) {
  nlohmann::json nodes = nlohmann::json::array(), all = nlohmann::json::array();
  for (int i = 0; i < copies; ++i) {
    nodes.push_back({{"mesh", 0}});
    all.push_back(i);
  }
  std::string body;
  const auto put = [&](auto value) { body.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) put(x);
  for (int i = 0; i < triangles; ++i)
    for (uint8_t k = 0; k < 3; ++k) put(k);
  while (body.size() % 4 != 0) body += '\0';
  const nlohmann::json json = {
      {"asset", {{"version", "2.0"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", all}}}},
      {"nodes", nodes},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
      {"accessors",
       {{{"bufferView", 0},
         {"componentType", 5126},
         {"count", 3},
         {"type", "VEC3"},
         {"min", {0, 0, 0}},
         {"max", {1, 1, 0}}},
        {{"bufferView", 1}, {"componentType", 5121}, {"count", 3 * triangles}, {"type", "SCALAR"}}}},
      {"bufferViews",
       {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 36}},
        {{"buffer", 0}, {"byteOffset", 36}, {"byteLength", 3 * triangles}}}},
      {"buffers", {{{"byteLength", body.size()}}}}};
  std::string text = json.dump();
  while (text.size() % 4 != 0) text += ' ';
  std::string out = "glTF";
  const auto word = [&](size_t value) {
    const auto four = static_cast<uint32_t>(value);
    out.append(reinterpret_cast<const char*>(&four), sizeof four);
  };
  word(2);
  word(12 + 8 + text.size() + 8 + body.size());
  word(text.size());
  out += "JSON" + text;
  word(body.size());
  out.append("BIN\0", 4);
  return out + body;
}

TEST(MeshIo, GivesWhatWasWritten) {
  const test::TemporaryFolder folder;
  const TriangleMesh box = box_mesh(3, 4, 5.5f);
  const TriangleMesh loaded = load_mesh(folder.write("box.ply", ply(box)));
  EXPECT_EQ(loaded.vertices_mm.size(), 8u);
  EXPECT_EQ(loaded.triangles.size(), 12u);
  EXPECT_DOUBLE_EQ(loaded.volume_mm3(), 66.0);
  EXPECT_EQ(load_mesh(folder.write("one.glb", glb_of_copies(1, 1))).triangles.size(), 1u);
}

TEST(MeshIo, TellsAMissingFileFromABadOne) {
  const test::TemporaryFolder folder;
  const std::string absent = (folder.path() / "absent.stl").string();
  expect_error(ErrorKind::not_found, "no such mesh: " + absent, [&] { load_mesh(absent); });
  const auto bad = folder.write("bad.stl", "solid");
  expect_error(ErrorKind::invalid_input, "mesh " + bad.string() + " cannot be used: it is cut off",
               [&] { load_mesh(bad); });
}

TEST(MeshIo, AFewBytesThatMakeMillionsOfTrianglesAreRefused) {
  const test::TemporaryFolder folder;
  const auto small = folder.write("copies.glb", glb_of_copies(200, 8000));
  expect_error(ErrorKind::invalid_input, small.string(), [&] { load_mesh(small); });
}

TEST(WritePly, KeepsNormalsWherePresentAndIsDeterministic) {
  const test::TemporaryFolder folder;
  TriangleMesh mesh = box_mesh(1, 1, 1);
  const std::string without = ply(mesh);
  mesh.normals.assign(8, Vec3f(0, 0.6f, 0.8f));
  const std::string with = ply(mesh);
  EXPECT_EQ(with, ply(mesh));
  EXPECT_EQ(without.find("property float nx"), std::string::npos);
  EXPECT_NE(with.find("property float nx"), std::string::npos);
  const size_t body = with.find("end_header\n") + 11;
  EXPECT_EQ(with.size() - body, 8u * 24u + 12u * 13u);
  float first[6];
  std::memcpy(first, with.data() + body, sizeof first);
  EXPECT_EQ(Vec3f(first[3], first[4], first[5]), mesh.normals[0]);
}

TEST(WritePly, LeavesNothingWhereItCannotWrite) {
  const test::TemporaryFolder folder;
  expect_error(ErrorKind::io, "missing",
               [&] { write_ply(folder.path() / "missing" / "a.ply", box_mesh(1, 1, 1)); });
  EXPECT_TRUE(folder.entries().empty());
}

}  // namespace
}  // namespace ream
