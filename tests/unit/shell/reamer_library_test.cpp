#include "shell/reamer_library.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <span>

#include "core/hash.hpp"
#include "geometry/mesh_io.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::shell {
namespace {

/// A parametric reamer as a file, its axis along x through (5, 6, 7).
std::string mesh_of(const std::string& words, const test::TemporaryFolder& folder, const std::string& file) {
  const Tool tool = make_tool(words);
  std::filesystem::create_directories(folder.path() / "reamers");
  const Pose mesh_from_tool{rotation_with_z_along(Vec3::UnitX()), Vec3(5, 6, 7)};
  const auto path = folder.path() / "reamers" / file;
  write_ply(path, tool.mesh.transformed(mesh_from_tool));
  return path.string();
}

TEST(ReamerLibrary, EveryNameIsAToolOfTheSizeItClaims) {
  std::set<std::string> names;
  for (const LibraryReamer& reamer : built_in_reamers()) {
    SCOPED_TRACE(reamer.name);
    EXPECT_TRUE(names.insert(reamer.name).second);
    const Tool tool = make_tool(reamer.name);
    EXPECT_EQ(tool.name, reamer.name);
    const Tool spelled = make_tool(reamer.words);
    EXPECT_EQ(hash_bytes(std::as_bytes(std::span(tool.profile.points))),
              hash_bytes(std::as_bytes(std::span(spelled.profile.points))));
    EXPECT_NEAR(2.0 * tool.profile.max_radius_mm(), reamer.diameter_mm, 1e-9);
    double nipple_mm = 0.0;
    for (size_t i = 0; i < tool.profile.roles.size(); ++i)
      if (tool.profile.roles[i] == SurfaceRole::guiding)
        nipple_mm = std::max(nipple_mm, tool.profile.points[i].z_mm);
    EXPECT_EQ(nipple_mm, reamer.nipple ? reamer.nipple->height_mm : 0.0);
    EXPECT_FALSE(reamer.cannulated && reamer.nipple);
    // Near the apex the cutting surface is the sphere of that radius.
    for (size_t i = 0; i < tool.profile.roles.size(); ++i) {
      const ProfilePoint& p = tool.profile.points[i + 1];
      if (tool.profile.roles[i] != SurfaceRole::cutting || p.radius_mm > 5.0) continue;
      EXPECT_NEAR(-p.z_mm, p.radius_mm * p.radius_mm / (2.0 * reamer.radius_mm), 0.02);
    }
    EXPECT_FALSE(reamer.description.empty());
  }
  EXPECT_EQ(find_reamer("thesis")->words, thesis_tool);
  EXPECT_EQ(find_reamer("nobody"), nullptr);
}

/// Recordings name reamers: what a name means must never change.
TEST(ReamerLibrary, NamesMeanWhatTheyAlwaysMeant) {
  std::string all;
  for (const LibraryReamer& reamer : built_in_reamers()) all += reamer.name + "=" + reamer.words + ";";
  EXPECT_EQ(all,
            "thesis=ellipse 16,8 nipple 3,8 back 1.25;thesis-appendix-a=ellipse 18.25,9;"
            "convex-30=sphere 30,14 nipple 3,8;convex-35=sphere 35,15 nipple 3,8;"
            "convex-40=sphere 40,16 nipple 3,8;convex-45=sphere 45,17 nipple 3,8;"
            "convex-50=sphere 50,18 nipple 3,8;convex-55=sphere 55,18 nipple 3,8;"
            "convex-60=sphere 60,19 nipple 3,8;cannulated-30=sphere 30,14;cannulated-35=sphere 35,15;"
            "cannulated-40=sphere 40,16;cannulated-45=sphere 45,17;cannulated-50=sphere 50,18;"
            "cannulated-55=sphere 55,18;cannulated-60=sphere 60,19;flat-30=sphere 1000,15 nipple 3,8;"
            "baseplate-27=sphere 60,13.5;");
}

TEST(ReamerLibrary, AnUnknownNameListsThoseThatExist) {
  const test::TemporaryFolder folder;
  test::expect_error(ErrorKind::usage, "convex-40", [] { make_tool("cube"); });
  test::expect_error(ErrorKind::usage, "cannulated-60", [&] { reamer_named("cube", folder.path()); });
  mesh_of("sphere 30,14", folder, "mine.ply");
  test::expect_error(ErrorKind::usage, "mine", [&] { reamer_named("cube", folder.path()); });
}

TEST(ReamerLibrary, TheUsersMeshesAreListedWithWhatIsNotedBesideThem) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(reamers_of(folder.path()).size(), built_in_reamers().size());
  const std::string file = mesh_of("sphere 35,15 nipple 3,8", folder, "mine.ply");
  mesh_of("sphere 30,14", folder, "thesis.ply");
  folder.write("reamers/broken.stl", "no mesh");
  folder.write("reamers/mine.json",
               R"({"axis": [5, 6, 7, 1, 0, 0], "cannulated": true, "description": "of our workshop"})");
  std::vector<std::string> warnings;
  const auto all = reamers_of(folder.path(), &warnings);
  ASSERT_EQ(all.size(), built_in_reamers().size() + 1);
  const LibraryReamer& mine = all.back();
  EXPECT_EQ(mine.name, "mine");
  EXPECT_EQ(mine.words, file);
  EXPECT_NEAR(mine.diameter_mm, 30.0, 0.05);
  EXPECT_NEAR(mine.radius_mm, 35.0, 1.5);
  EXPECT_TRUE(mine.cannulated);
  EXPECT_EQ(mine.description, "of our workshop");
  EXPECT_EQ(mine.axis->direction, Vec3::UnitX());
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("broken.stl"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[1].find("not that of a built-in"), std::string::npos) << warnings[1];
  EXPECT_EQ(reamer_named("mine", folder.path()).words, file);
  EXPECT_EQ(described_reamer(file).description, "of our workshop");
  EXPECT_EQ(axis_noted_for(file)->point_mm, Vec3(5, 6, 7));
  folder.write("reamers/mine.json", R"({"axis": [5, 6, 7, 0, 0, 0]})");
  test::expect_error(ErrorKind::invalid_input, "axis", [&] { described_reamer(file); });
  folder.write("reamers/mine.json", R"({"axes": 1})");
  test::expect_error(ErrorKind::invalid_input, "axes", [&] { reamer_named("mine", folder.path()); });
}

TEST(ReamerLibrary, AnyWordsCanBeDescribed) {
  const LibraryReamer named = described_reamer("ellipse 16,8 nipple 3,8 back 1.25");
  EXPECT_EQ(named.name, "thesis");
  const LibraryReamer other = described_reamer("sphere 33,12 nipple 2,5");
  EXPECT_EQ(other.name, "");
  EXPECT_NEAR(other.diameter_mm, 24.0, 1e-9);
  EXPECT_NEAR(other.radius_mm, 33.0, 1e-3);
  EXPECT_EQ(other.nipple->height_mm, 5.0);
}

TEST(ReamerLibrary, AnImplantGetsTheNearestRadius) {
  EXPECT_EQ(reamer_for_implant(10.0).name, "convex-30");
  EXPECT_EQ(reamer_for_implant(41.0).name, "convex-40");
  EXPECT_EQ(reamer_for_implant(44.0).name, "convex-45");
  EXPECT_EQ(reamer_for_implant(90.0).name, "convex-60");
}

}  // namespace
}  // namespace ream::shell
