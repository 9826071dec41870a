#include "unit/layering/layering.hpp"
#include "support/places.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/temporary_folder.hpp"

namespace ream::layering {
namespace {

using Found = std::vector<std::string>;

std::string lines(const Found& found) {
  std::string text;
  for (const std::string& line : found) text += "\n  " + line;
  return text;
}

TEST(Layering, IncludesPointDownOnly) {
  const Found found = arrow_violations(test::source_folder());
  EXPECT_TRUE(found.empty()) << lines(found);
}

TEST(Layering, BigLibrariesStayInTheirRoom) {
  const Found found = library_violations(test::source_folder());
  EXPECT_TRUE(found.empty()) << lines(found);
}

TEST(Layering, FilesAreShort) {
  const Found found = length_violations(test::source_folder());
  EXPECT_TRUE(found.empty()) << lines(found);
}

TEST(LayeringPlan, NoRoomReachesItself) {
  for (const auto& [room, targets] : allowed_rooms()) EXPECT_FALSE(targets.contains(room)) << room;
}

TEST(LayeringPlan, FollowsArrowsToTheGround) {
  for (const auto& [room, targets] : allowed_rooms()) {
    EXPECT_TRUE(room == "core" || targets.contains("core")) << room;
    EXPECT_TRUE(room == "app" || allowed_rooms().at("app").contains(room)) << room;
  }
  EXPECT_TRUE(allowed_rooms().at("collide").contains("gpu"));
  EXPECT_FALSE(allowed_rooms().at("collide").contains("force"));
}

TEST(LayeringChecker, AcceptsAnArrowThatIsReached) {
  const test::TemporaryFolder tree;
  tree.write("server/stream/codec.cpp",
             "#include \"stream/codec.hpp\"\n#include \"voxel/bricks.hpp\"\n#include <vector>\n");
  EXPECT_EQ(arrow_violations(tree.path()), Found{});
}

TEST(LayeringChecker, NamesFileAndLineOfAnIncludeThatPointsUp) {
  const test::TemporaryFolder tree;
  tree.write("server/core/log.cpp", "// text\n\n  #  include \"sim/step.hpp\"  // why\n");
  EXPECT_EQ(arrow_violations(tree.path()),
            Found{"server/core/log.cpp:3: sim/step.hpp: core may not include sim"});
}

TEST(LayeringChecker, NoticesASidewaysIncludeInAHeaderDeepInARoom) {
  const test::TemporaryFolder tree;
  tree.write("server/force/models/a.hpp", "#include \"voxel/voxel_grid.hpp\"\n");
  EXPECT_EQ(arrow_violations(tree.path()),
            Found{"server/force/models/a.hpp:1: voxel/voxel_grid.hpp: force may not include voxel"});
}

TEST(LayeringChecker, NoticesAnAngledIncludeOfOurOwnHeaderButNotTheSystems) {
  const test::TemporaryFolder tree;
  tree.write("server/net/listener.hpp", "#pragma once\n");
  tree.write("server/store/a.cpp", "#include <net/if.h>\n#include <net/listener.hpp>\n");
  EXPECT_EQ(arrow_violations(tree.path()),
            Found{"server/store/a.cpp:2: net/listener.hpp: store may not include net"});
}

TEST(LayeringChecker, RefusesDetoursAndUnknownRooms) {
  const test::TemporaryFolder tree;
  tree.write("server/core/a.cpp", "#include \"../sim/step.hpp\"\n#include \"utility/b.hpp\"\n");
  tree.write("server/misc/c.cpp", "#include <vector>\n");
  EXPECT_EQ(arrow_violations(tree.path()),
            (Found{"server/core/a.cpp:1: ../sim/step.hpp: leaves its folder by \"..\"",
                   "server/core/a.cpp:2: utility/b.hpp: \"utility\" is no room",
                   "server/misc:1: is no room of the house plan"}));
}

TEST(LayeringChecker, KernelsStandAlone) {
  const test::TemporaryFolder tree;
  tree.write("kernels/common.h", "");
  tree.write("kernels/removal.cl", "#include \"common.h\"\n#include \"voxel/bricks.hpp\"\n");
  EXPECT_EQ(arrow_violations(tree.path()),
            Found{"kernels/removal.cl:2: voxel/bricks.hpp: kernels include only files of kernels/"});
}

TEST(LayeringChecker, NamesALibraryOutsideItsRoom) {
  const test::TemporaryFolder tree;
  const char* const all =
      "#include <CL/opencl.hpp>\n#include <boost/asio.hpp>\n#include <boost/beast/core.hpp>\n#include "
      "<itkImage.h>\n"
      "#include <assimp/scene.h>\n#include <soci/soci.h>\n#include <GL/osmesa.h>\n#include <nats/nats.h>\n"
      "#include <sodium.h>\n";
  for (const char* room : {"gpu", "net", "ct", "geometry", "store", "render", "stream", "access", "sim"})
    tree.write(std::string("server/") + room + "/a.cpp", all);
  const Found found = library_violations(tree.path());
  // 9 headers in 9 rooms, each allowed once; Beast and Asio share a room.
  EXPECT_EQ(found.size(), 81u - 9u) << lines(found);
  EXPECT_EQ(std::count(found.begin(), found.end(), "server/sim/a.cpp:4: itkImage.h: ITK belongs to ct"), 1);
  for (const std::string& line : found) {
    const std::string room = line.substr(7, line.find('/', 7) - 7);
    EXPECT_FALSE(line.ends_with(" belongs to " + room)) << line;
  }
}

TEST(LayeringChecker, CountsLines) {
  const test::TemporaryFolder tree;
  tree.write("server/core/fits.hpp", std::string(150, '\n'));
  tree.write("server/core/fits.cpp", std::string(400, '\n'));
  tree.write("server/core/long.hpp", std::string(151, '\n'));
  tree.write("server/core/long.cpp", std::string(401, '\n'));
  tree.write("kernels/long.cl", std::string(401, '\n'));
  EXPECT_EQ(length_violations(tree.path()), (Found{"server/core/long.cpp:401: longer than 400 lines",
                                                   "server/core/long.hpp:151: longer than 150 lines",
                                                   "kernels/long.cl:401: longer than 400 lines"}));
}

}  // namespace
}  // namespace ream::layering
