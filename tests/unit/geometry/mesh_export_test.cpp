#include "geometry/mesh_export.hpp"

#include <gtest/gtest.h>

#include "core/file.hpp"
#include "geometry/mesh_io.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_meshes.hpp"

namespace ream {
namespace {

TEST(WriteMesh, EveryFormIsReadBackAsTheSameBody) {
  const test::TemporaryFolder folder;
  const TriangleMesh box = test::box_mesh(Vec3f(1.0f, 2.0f, 3.0f));
  for (const std::string& ending : mesh_file_endings()) {
    const auto path = folder.path() / ("box" + ending);
    write_mesh(path, box, "millimetres, LPS");
    const TriangleMesh read = load_mesh(path);
    const double scale = ending == ".glb" ? 1.0e-3 : 1.0;
    EXPECT_EQ(read.triangles.size(), box.triangles.size()) << ending;
    EXPECT_NEAR(read.volume_mm3() / (scale * scale * scale), 48.0, 1e-3) << ending;
    EXPECT_NEAR(read.bounds().max.z() / scale, 3.0, 1e-5) << ending;
  }
}

TEST(WriteMesh, RefusesOtherEndingsAndPlaces) {
  const test::TemporaryFolder folder;
  const TriangleMesh box = test::box_mesh(Vec3f(1.0f, 1.0f, 1.0f));
  test::expect_error(ErrorKind::invalid_input, ".ply, .stl or .glb",
                     [&] { write_mesh(folder.path() / "box.obj", box, ""); });
  test::expect_error(ErrorKind::io, "nowhere",
                     [&] { write_mesh(folder.path() / "nowhere/box.stl", box, ""); });
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace ream
