#include "render/scene_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "core/error.hpp"
#include "core/file.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"
#include "support/temporary_folder.hpp"

namespace ream::render {
namespace {

namespace fs = std::filesystem;

/// Two layers that differ in all that a layer may have.
class SceneFile : public testing::Test {
 protected:
  void SetUp() override {
    std::mt19937 random(test::seed(1));
    std::uniform_real_distribution<float> anything(-100.0f, 100.0f);
    const auto some = [&] { return Vec3f(anything(random), anything(random), anything(random)); };
    for (int i = 0; i < 50; ++i) {
      mesh_.vertices_mm.push_back(some());
      mesh_.normals.push_back(some());
      colours_.push_back({static_cast<uint8_t>(i), 1, 2, 255});
    }
    for (uint32_t i = 0; i + 2 < 50; ++i) mesh_.triangles.push_back({i, i + 1, i + 2});
    bare_ = mesh_;
    bare_.normals.clear();
    Pose pose;
    pose.rotation << 0, -1, 0, 0.6, 0, -0.8, 0.8, 0, 0.6;
    pose.translation_mm = some().cast<double>() / 3.0;
    scene_.layers = {{&mesh_, pose, some(), 0.25f, &colours_}, {&bare_, {}, some(), 1.0f, nullptr}};
    scene_.camera = {some().cast<double>(), some().cast<double>(), some().cast<double>(), 0.7};
    scene_.width = 33;
    scene_.height = 77;
  }
  fs::path file() const { return folder_.path() / "scene"; }

  test::TemporaryFolder folder_;
  TriangleMesh mesh_, bare_;
  std::vector<VertexColour> colours_;
  Scene scene_;
};

TEST_F(SceneFile, IsReadAsItWasWritten) {
  write_scene(file(), scene_);
  const auto read = read_scene(file());
  EXPECT_EQ(read.scene.width, 33);
  EXPECT_EQ(read.scene.height, 77);
  EXPECT_EQ(read.scene.camera.eye_mm, scene_.camera.eye_mm);
  EXPECT_EQ(read.scene.camera.target_mm, scene_.camera.target_mm);
  EXPECT_EQ(read.scene.camera.up, scene_.camera.up);
  EXPECT_EQ(read.scene.camera.vertical_field_of_view_rad, 0.7);
  ASSERT_EQ(read.scene.layers.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    const Layer &was = scene_.layers[i], &is = read.scene.layers[i];
    EXPECT_EQ(is.mesh->vertices_mm, was.mesh->vertices_mm);
    EXPECT_EQ(is.mesh->normals, was.mesh->normals);
    EXPECT_EQ(is.mesh->triangles, was.mesh->triangles);
    EXPECT_EQ(is.world_from_mesh.rotation, was.world_from_mesh.rotation);
    EXPECT_EQ(is.world_from_mesh.translation_mm, was.world_from_mesh.translation_mm);
    EXPECT_EQ(is.colour, was.colour);
    EXPECT_EQ(is.opacity, was.opacity);
    ASSERT_EQ(is.colours == nullptr, was.colours == nullptr);
  }
  const auto& colours = *read.scene.layers[0].colours;
  ASSERT_EQ(colours.size(), 50u);
  for (size_t i = 0; i < 50; ++i) EXPECT_EQ(colours[i].red, i);
  EXPECT_EQ(colours[49].hatch, 255);
}

TEST_F(SceneFile, CutOffAnywhereItIsAnErrorAndTakesNoMemory) {
  write_scene(file(), scene_);
  const auto bytes = fs::file_size(file());
  for (uintmax_t left = 0; left < bytes; left += 1 + left / 16) {
    fs::resize_file(file(), left);
    test::expect_error(ErrorKind::io, "not whole", [&] { read_scene(file()); });
    write_scene(file(), scene_);
  }
  // A number of vertices that only a larger file could hold; a layer counts after 112 bytes.
  std::fstream(file(), std::ios::in | std::ios::out | std::ios::binary)
      .seekp(104 + 112)
      .write("\xff\xff\xff\xff\xff\xff\xff\x0f", 8);
  test::expect_error(ErrorKind::io, "not whole", [&] { read_scene(file()); });
}

TEST_F(SceneFile, OfAnotherBuildIsRefused) {
  write_scene(file(), scene_);
  std::fstream(file(), std::ios::in | std::ios::out | std::ios::binary).put('x');
  test::expect_error(ErrorKind::invalid_input, "two builds", [&] { read_scene(file()); });
}

TEST_F(SceneFile, ATriangleHasVertices) {
  bare_.triangles.push_back({0, 1, 50});
  write_scene(file(), scene_);
  test::expect_error(ErrorKind::invalid_input, "vertex", [&] { read_scene(file()); });
}

TEST_F(SceneFile, WhatCannotBeWrittenIsNamed) {
  test::expect_error(ErrorKind::io, "/dev/full", [&] { write_scene("/dev/full", scene_); });
}

}  // namespace
}  // namespace ream::render
