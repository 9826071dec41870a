#include "geometry/scene_export.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <random>

#include "core/file.hpp"
#include "geometry/mesh_io.hpp"
#include "support/seed.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_meshes.hpp"

namespace ream {
namespace {

using nlohmann::json;

const std::string remark = "millimetres, LPS, right shoulder";

class SceneExport : public testing::Test {
 protected:
  SceneExport() {
    std::mt19937 random(test::seed(11));
    bone_ = test::box_mesh({10.0f, 4.0f, 3.0f});
    implant_ = test::box_mesh({1.0f, 2.0f, 2.0f});
    for (auto& v : implant_.vertices_mm) v += Vec3f(40.0f, 0.0f, 0.0f);
    for (TriangleMesh* mesh : {&bone_, &implant_})
      for (const Vec3f& v : mesh->vertices_mm) mesh->normals.push_back(v.normalized());
    objects_.resize(2);
    objects_[0].name = "bone";
    objects_[0].mesh = &bone_;
    objects_[1].name = "implant";
    objects_[1].mesh = &implant_;
    for (uint8_t i = 0; i < 8; ++i) objects_[0].colours.push_back({i, 128, 255});
    objects_[0].properties = {{"deviation_plan", {-127, -1, 0, 1, 2, 3, 126, 127}}};
  }

  TriangleMesh read_back(const std::string& bytes, const char* name) {
    const auto path = folder_.path() / name;
    write_file_atomically(path, bytes);
    return load_mesh(path);
  }

  TriangleMesh bone_, implant_;
  std::vector<SceneObject> objects_;
  test::TemporaryFolder folder_;
};

TEST_F(SceneExport, StlIsReadBackWithItsVolumeAndRemark) {
  const std::string stl = stl_of(bone_, remark);
  EXPECT_EQ(stl.size(), 84u + 50u * bone_.triangles.size());
  EXPECT_TRUE(stl.starts_with(remark));
  EXPECT_FALSE(stl.starts_with("solid")) << "that is how a text STL begins";
  const TriangleMesh back = read_back(stl, "a.stl");
  EXPECT_EQ(back.vertices_mm.size(), 8u);
  EXPECT_NEAR(back.volume_mm3(), bone_.volume_mm3(), 1e-3);
  // The first triangle's normal points outwards.
  Vec3f normal, corner;
  std::memcpy(normal.data(), stl.data() + 84, 12);
  std::memcpy(corner.data(), stl.data() + 96, 12);
  EXPECT_NEAR(normal.norm(), 1.0f, 1e-6f);
  EXPECT_GT(normal.dot(corner), 0.0f);
}

TEST_F(SceneExport, PlyHoldsBothObjectsWithColoursAndDeviations) {
  const std::string ply = ply_of(objects_, remark);
  const TriangleMesh back = read_back(ply, "a.ply");
  EXPECT_EQ(back.triangles.size(), 24u);
  EXPECT_NEAR(back.volume_mm3(), bone_.volume_mm3() + implant_.volume_mm3(), 1e-3);
  const std::string header = ply.substr(0, ply.find("end_header\n") + 11);
  EXPECT_NE(header.find("comment " + remark), std::string::npos);
  EXPECT_NE(header.find("comment object 1 is the implant"), std::string::npos);
  EXPECT_NE(header.find("property char deviation_plan"), std::string::npos);
  // Position, normal, colour, property: 12 + 12 + 3 + 1 bytes.
  constexpr size_t stride = 28;
  EXPECT_EQ(ply.size(), header.size() + 16 * stride + 24 * 14);
  const auto byte = [&](size_t vertex, size_t offset) {
    return static_cast<int>(static_cast<signed char>(ply[header.size() + vertex * stride + offset]));
  };
  EXPECT_EQ(byte(3, 24), 3);
  EXPECT_EQ(byte(0, 27), -127);
  EXPECT_EQ(byte(7, 27), 127);
  EXPECT_EQ(byte(8, 27), -128) << "nothing is known of the implant's deviation";
  EXPECT_EQ(static_cast<int>(ply.back()), 1) << "the last face is the implant's";
}

TEST_F(SceneExport, PlyHasOnlyWhatThereIs) {
  objects_[0].colours.clear();
  objects_[0].properties.clear();
  implant_.normals.clear();
  const std::string ply = ply_of(objects_, remark);
  for (const char* word : {"property char", "red", "float nx"})
    EXPECT_EQ(ply.find(word), std::string::npos) << word;
  EXPECT_EQ(read_back(ply, "a.ply").triangles.size(), 24u);
}

/// The JSON part of a GLB file.
json glb_json(const std::string& glb) {
  uint32_t words[5];
  std::memcpy(words, glb.data(), sizeof words);
  EXPECT_EQ(words[0], 0x46546c67u);
  EXPECT_EQ(words[1], 2u);
  EXPECT_EQ(words[2], glb.size());
  return json::parse(glb.substr(20, words[3]));
}

TEST_F(SceneExport, GlbIsInMetresWithYUpAndSaysWhatItWas) {
  const std::string glb = glb_of(objects_, remark);
  const json scene = glb_json(glb);
  EXPECT_EQ(scene.at("meshes").size(), 2u);
  EXPECT_NE(scene.dump().find(remark), std::string::npos);
  EXPECT_TRUE(scene["meshes"][0]["primitives"][0]["attributes"].contains("COLOR_0"));
  EXPECT_FALSE(scene["meshes"][1]["primitives"][0]["attributes"].contains("COLOR_0"));
  // Read by the rules of the format: left, superior, anterior, in metres.
  const TriangleMesh back = read_back(glb, "a.glb");
  const Aabb box = back.bounds();
  EXPECT_NEAR(box.min.x(), -0.010, 1e-6);
  EXPECT_NEAR(box.max.x(), 0.041, 1e-6);
  EXPECT_NEAR(box.max.y(), 0.003, 1e-6) << "superior, LPS z, is up";
  EXPECT_NEAR(box.max.z(), 0.004, 1e-6) << "LPS y";
  EXPECT_NEAR(back.volume_mm3() * 1e9, bone_.volume_mm3() + implant_.volume_mm3(), 1e-2)
      << "not turned inside out";
}

TEST_F(SceneExport, GlbKeepsTheOrderOfDirections) {
  // One triangle whose corners tell left, posterior and superior apart.
  TriangleMesh mesh;
  mesh.vertices_mm = {{1000, 0, 0}, {0, 2000, 0}, {0, 0, 3000}};
  mesh.triangles = {{0, 1, 2}};
  SceneObject object;
  object.name = "bone";
  object.mesh = &mesh;
  const TriangleMesh back = read_back(glb_of({&object, 1}, remark), "a.glb");
  ASSERT_EQ(back.vertices_mm.size(), 3u);
  EXPECT_LT((back.vertices_mm[back.triangles[0][0]] - Vec3f(1, 0, 0)).norm(), 1e-6f);
  EXPECT_LT((back.vertices_mm[back.triangles[0][1]] - Vec3f(0, 0, -2)).norm(), 1e-6f)
      << "posterior is behind";
  EXPECT_LT((back.vertices_mm[back.triangles[0][2]] - Vec3f(0, 3, 0)).norm(), 1e-6f);
}

TEST_F(SceneExport, GlbHoldsMoreVerticesThanSixteenBitsCount) {
  constexpr uint32_t edge = 300;
  TriangleMesh mesh;
  for (uint32_t i = 0; i < edge * edge; ++i)
    mesh.vertices_mm.emplace_back(1000.0f * static_cast<float>(i % edge),
                                  1000.0f * static_cast<float>(i / edge), 0.0f);
  for (uint32_t i = 0; i + edge + 1 < edge * edge; ++i)
    if (i % edge + 1 < edge) mesh.triangles.push_back({i, i + 1, i + edge});
  SceneObject object;
  object.name = "bone";
  object.mesh = &mesh;
  const TriangleMesh back = read_back(glb_of({&object, 1}, remark), "a.glb");
  ASSERT_EQ(back.triangles.size(), mesh.triangles.size());
  for (const auto& t : back.triangles)
    ASSERT_LT((back.vertices_mm[t[1]] - back.vertices_mm[t[0]] - Vec3f(1, 0, 0)).norm(), 1e-3f);
}

}  // namespace
}  // namespace ream
