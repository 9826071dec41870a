#include "render/snapshot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <thread>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/units.hpp"
#include "render/camera.hpp"
#include "support/expect_error.hpp"

namespace ream::render {
namespace {

constexpr int size = 200;

/// Latitudes and longitudes; the poles are on z.
TriangleMesh sphere(double radius_mm, bool with_normals = true) {
  constexpr uint32_t rings = 48, segments = 96;
  TriangleMesh mesh;
  for (uint32_t i = 0; i <= rings; ++i)
    for (uint32_t j = 0; j < segments; ++j) {
      const double a = pi * i / rings, b = 2 * pi * j / segments;
      const Vec3 n(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
      mesh.vertices_mm.push_back((radius_mm * n).cast<float>());
      if (with_normals) mesh.normals.push_back(n.cast<float>());
    }
  for (uint32_t i = 0; i < rings; ++i)
    for (uint32_t j = 0; j < segments; ++j) {
      const uint32_t a = i * segments + j, b = i * segments + (j + 1) % segments;
      mesh.triangles.push_back({a, a + segments, b});
      mesh.triangles.push_back({b, a + segments, b + segments});
    }
  return mesh;
}

Camera camera_at(double distance_mm) {
  Camera camera;
  camera.eye_mm = Vec3(0, -distance_mm, 0);
  camera.target_mm = Vec3::Zero();
  camera.vertical_field_of_view_rad = 0.6;
  return camera;
}

std::array<int, 3> pixel(const Image& image, int x, int y) {
  const uint8_t* p = image.rgba.data() +
                     4 * (static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x));
  return {p[0], p[1], p[2]};
}

/// Pixels that differ from the top left corner, which must be background.
int covered(const Image& image) {
  int count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) count += pixel(image, x, y) != pixel(image, 0, 0);
  return count;
}

Pose at(const Vec3& position_mm) {
  Pose pose;
  pose.translation_mm = position_mm;
  return pose;
}

bool reddish(const std::array<int, 3>& p) { return p[0] > p[2] + 60; }
bool bluish(const std::array<int, 3>& p) { return p[2] > p[0] + 60; }

const Vec3f red(0.8f, 0.1f, 0.1f), blue(0.1f, 0.1f, 0.8f);

TEST(Snapshot, SphereCoversItsSilhouette) {
  const double radius_mm = 10, distance_mm = 50;
  const TriangleMesh mesh = sphere(radius_mm);
  const Image image = draw({{&mesh, {}, red, 1.0f}}, camera_at(distance_mm), size, size);
  ASSERT_EQ(image.rgba.size(), 4u * size * size);
  // The silhouette is the cone that touches the sphere; counted with its antialiased rim, hence half a rim
  // more.
  const double radius_px = std::tan(std::asin(radius_mm / distance_mm)) / std::tan(0.3) * size / 2;
  EXPECT_NEAR(covered(image), pi * radius_px * radius_px, 2 * pi * radius_px);
  EXPECT_TRUE(reddish(pixel(image, size / 2, size / 2)));
}

TEST(Snapshot, WorldUpIsUpAndRightIsRight) {
  const TriangleMesh mesh = sphere(3);
  const Image image = draw({{&mesh, at({8, 0, 0}), red, 1.0f}, {&mesh, at({0, 0, 8}), blue, 1.0f}},
                           camera_at(50), size, size);
  const int shift = static_cast<int>(8 / (50 * std::tan(0.3)) * size / 2);
  EXPECT_TRUE(reddish(pixel(image, size / 2 + shift, size / 2)));
  EXPECT_TRUE(bluish(pixel(image, size / 2, size / 2 - shift)));
}

TEST(Snapshot, NearerHidesFartherInAnyOrder) {
  const TriangleMesh mesh = sphere(5);
  const Layer near_red{&mesh, at({0, -10, 0}), red, 1.0f}, far_blue{&mesh, at({0, 10, 0}), blue, 1.0f};
  for (const auto& layers : {std::vector{near_red, far_blue}, std::vector{far_blue, near_red}})
    EXPECT_TRUE(reddish(pixel(draw(layers, camera_at(50), size, size), size / 2, size / 2)));
}

TEST(Snapshot, TranslucentShowsWhatIsBehindWhateverTheOrder) {
  const TriangleMesh mesh = sphere(5);
  const Layer near_red{&mesh, at({0, -10, 0}), red, 0.4f}, far_blue{&mesh, at({0, 10, 0}), blue, 1.0f};
  const Image a = draw({near_red, far_blue}, camera_at(50), size, size);
  const Image b = draw({far_blue, near_red}, camera_at(50), size, size);
  EXPECT_EQ(a.rgba, b.rgba);
  const auto p = pixel(a, size / 2, size / 2);
  EXPECT_GT(p[0], 60);
  EXPECT_GT(p[2], 60);
  EXPECT_EQ(a.rgba[4 * (size / 2 * size + size / 2) + 3], 255);
}

TEST(Snapshot, WithoutNormalsTheTrianglesThemselvesAreLit) {
  const TriangleMesh smooth = sphere(10), flat = sphere(10, false);
  const Image a = draw({{&smooth, {}, red, 1.0f}}, camera_at(50), size, size);
  const Image b = draw({{&flat, {}, red, 1.0f}}, camera_at(50), size, size);
  for (const int x : {80, 100, 120})
    for (const int y : {80, 100, 120}) EXPECT_NEAR(pixel(a, x, y)[0], pixel(b, x, y)[0], 12) << x << " " << y;
}

TEST(Snapshot, NothingToDrawIsPlainBackground) {
  const TriangleMesh empty;
  EXPECT_EQ(covered(draw({}, camera_at(50), 32, 16)), 0);
  EXPECT_EQ(covered(draw({{&empty, {}, red, 0.5f}}, camera_at(50), 32, 16)), 0);
}

/// As reports and downloads have several, of sessions that end at one time.
TEST(Snapshot, IsTheSameWhenManyAreDrawnAtOnce) {
  const TriangleMesh mesh = sphere(10);
  const Image alone = draw({{&mesh, {}, red, 1.0f}}, camera_at(50), 64, 64);
  std::vector<Image> drawn(4);
  {
    std::vector<std::jthread> threads;
    for (Image& image : drawn)
      threads.emplace_back([&] { image = draw({{&mesh, {}, red, 1.0f}}, camera_at(50), 64, 64); });
  }
  for (const Image& image : drawn) EXPECT_EQ(image.rgba, alone.rgba);
}

/// A report goes without pictures then.
TEST(Snapshot, WithoutAFolderForTemporaryFilesIsUnavailable) {
  ::setenv("TMPDIR", "/nowhere", 1);
  test::expect_error(ErrorKind::unavailable,
                     "the picture cannot be drawn: ", [] { draw({}, camera_at(50), 8, 8); });
  ::unsetenv("TMPDIR");
}

TEST(Snapshot, RefusesImpossibleSizesAndCameras) {
  EXPECT_THROW(draw({}, camera_at(50), 0, 10), Error);
  EXPECT_THROW(draw({}, camera_at(50), 10, 100000), Error);
  EXPECT_THROW(draw({}, camera_at(0), 10, 10), Error);
}

TEST(Png, HasSignatureAndSize) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "ream_snapshot_test.png";
  write_png(path, draw({}, camera_at(50), 37, 21));
  const std::vector<std::byte> bytes = read_binary_file(path);
  const std::vector<uint8_t> signature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  ASSERT_GT(bytes.size(), 33u);
  for (size_t i = 0; i < signature.size(); ++i) EXPECT_EQ(static_cast<uint8_t>(bytes[i]), signature[i]);
  EXPECT_EQ(static_cast<uint8_t>(bytes[19]), 37);
  EXPECT_EQ(static_cast<uint8_t>(bytes[23]), 21);
  std::filesystem::remove(path);
}

TEST(Png, UnwritablePathIsNamedAndNothingIsLeft) {
  const std::filesystem::path path = "/proc/no-such-folder/picture.png";
  try {
    write_png(path, draw({}, camera_at(50), 4, 4));
    FAIL() << "must throw";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::io);
    EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
  }
  EXPECT_THROW(write_png("/tmp/never.png", Image{2, 2, {}}), Error);
  EXPECT_FALSE(std::filesystem::exists("/tmp/never.png"));
}

TEST(Snapshot, VerticesMayHaveColoursOfTheirOwn) {
  const TriangleMesh mesh = sphere(10);
  std::vector<VertexColour> colours;
  for (const Vec3f& v : mesh.vertices_mm)
    colours.push_back(v.x() > 0.0f ? VertexColour{200, 20, 20, 0} : VertexColour{20, 20, 200, 0});
  Layer layer;
  layer.mesh = &mesh;
  layer.colours = &colours;
  const Image image = draw({layer}, camera_at(50), size, size);
  EXPECT_TRUE(reddish(pixel(image, size / 2 + 30, size / 2)));
  EXPECT_TRUE(bluish(pixel(image, size / 2 - 30, size / 2)));
}

TEST(Snapshot, HatchedColoursAreTornByDarkStripes) {
  const TriangleMesh mesh = sphere(10);
  const auto darkest_and_brightest = [&](uint8_t hatch) {
    const std::vector<VertexColour> colours(mesh.vertices_mm.size(), VertexColour{200, 200, 200, hatch});
    Layer layer;
    layer.mesh = &mesh;
    layer.colours = &colours;
    const Image image = draw({layer}, camera_at(50), size, size);
    int darkest = 255, brightest = 0;
    for (int x = size / 2 - 12; x < size / 2 + 12; ++x) {
      darkest = std::min(darkest, pixel(image, x, size / 2)[0]);
      brightest = std::max(brightest, pixel(image, x, size / 2)[0]);
    }
    return std::pair(darkest, brightest);
  };
  const auto [plain_darkest, plain_brightest] = darkest_and_brightest(0);
  EXPECT_LT(plain_brightest - plain_darkest, 40);
  const auto [darkest, brightest] = darkest_and_brightest(255);
  EXPECT_GT(brightest - darkest, 70);
}

TEST(Snapshot, PlacesAreWhereThingsAreDrawn) {
  const TriangleMesh mesh = sphere(0.7);
  Camera camera = camera_at(50);
  camera.eye_mm += Vec3(7, 3, -4);
  for (const Vec3& at_mm : {Vec3(5, 2, 6), Vec3(-7, 1, -3), Vec3(0, -9, 4)}) {
    const Image image = draw({{&mesh, at(at_mm), red, 1.0f}}, camera, 2 * size, size);
    const auto place = place_in_picture(camera, 2.0, at_mm);
    ASSERT_TRUE(place);
    EXPECT_TRUE(reddish(
        pixel(image, static_cast<int>((*place)[0] * 2 * size), static_cast<int>((*place)[1] * size))));
  }
  EXPECT_FALSE(place_in_picture(camera, 2.0, Vec3(0, -200, 0))) << "behind the camera";
}

}  // namespace
}  // namespace ream::render
