#include "unit/layering/layering.hpp"
#include "support/places.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

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

TEST(Layering, ThreadsHaveASignalStack) {
  const Found found = thread_violations(test::source_folder());
  EXPECT_TRUE(found.empty()) << lines(found);
}

TEST(Layering, JsonIsReadToABoundedDepth) {
  const Found found = json_violations(test::source_folder());
  EXPECT_TRUE(found.empty()) << lines(found);
}

TEST(Layering, FunctionsAreShort) {
  const Found found = function_violations(test::source_folder());
  EXPECT_TRUE(found.empty()) << lines(found);
}

TEST(Layering, NoFileIncludesItselfByADetour) {
  const Found found = file_cycles(test::source_folder());
  EXPECT_TRUE(found.empty()) << lines(found);
}

TEST(Layering, NoFolderIncludesItselfByADetour) {
  const Found found = folder_cycles(test::source_folder());
  EXPECT_LE(static_cast<int>(found.size()), server_limits.folder_cycles) << lines(found);
}

TEST(Layering, AHeaderIsOfANounNotOfAFunction) {
  const Found found = single_function_headers(test::source_folder());
  EXPECT_LE(static_cast<int>(found.size()), server_limits.single_function_headers) << lines(found);
}

TEST(Layering, PrivatePartsAreInWhatUsesThem) {
  const Found found = private_headers(test::source_folder());
  std::cout << found.size() << " headers with one user, in their own folder, and no test:" << lines(found)
            << "\n";
  EXPECT_LE(static_cast<int>(found.size()), server_limits.private_headers);
}

TEST(Layering, TheServerIsOfThisSize) {
  const Totals sizes = totals(test::source_folder());
  std::cout << "server/: " << sizes.files << " files, " << sizes.lines << " lines, median file "
            << sizes.median_file_lines << " lines; " << sizes.functions << " functions, 90 % have "
            << sizes.p90_function_lines << " lines at most\n";
  EXPECT_LE(sizes.files, server_limits.files);
  EXPECT_LE(sizes.lines, server_limits.lines);
  EXPECT_GE(sizes.median_file_lines, server_limits.min_median_file_lines);
  EXPECT_LE(sizes.median_file_lines, server_limits.max_median_file_lines);
  EXPECT_LE(sizes.p90_function_lines, server_limits.p90_function_lines);
}

TEST(LayeringPlan, NoRoomReachesItself) {
  for (const auto& [room, targets] : allowed_rooms()) EXPECT_FALSE(targets.contains(room)) << room;
}

TEST(LayeringPlan, FollowsArrowsToTheGround) {
  for (const auto& [room, targets] : allowed_rooms()) {
    EXPECT_TRUE(room == "core" || targets.contains("core")) << room;
    EXPECT_TRUE(room == "app" || room == "reader" || room == "renderer" ||
                allowed_rooms().at("app").contains(room))
        << room;
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

TEST(LayeringChecker, NamesAThreadWithoutASignalStack) {
  const test::TemporaryFolder tree;
  tree.write("server/core/signal_handlers.hpp", "  return std::thread([] {});\n");
  tree.write("server/sim/a.cpp",
             "std::thread thread_;\nthread_ = start_thread([] {});\nthread_ = std::thread([] {});\n"
             ": thread_([] {})\nthreads_.emplace_back([] {});\nstd::vector<std::jthread> all;\n");
  EXPECT_EQ(thread_violations(tree.path()),
            (Found{"server/sim/a.cpp:3: use start_thread() or start_task()",
                   "server/sim/a.cpp:4: use start_thread() or start_task()",
                   "server/sim/a.cpp:5: use start_thread() or start_task()",
                   "server/sim/a.cpp:6: use start_thread() or start_task()"}));
}

TEST(LayeringChecker, NamesJsonThatIsReadToAnyDepth) {
  const test::TemporaryFolder tree;
  tree.write("server/core/json.cpp", "json::sax_parse(text, &builder)\n");
  tree.write("server/api/a.cpp",
             "parse_json(text);\nauto a = nlohmann::json::parse(text);\nin >> json;\nstream << json;\n"
             "json::accept(text);\njson::from_cbor(bytes);\n");
  const std::string words = ": use parse_json() or parse_json_or_discard()";
  EXPECT_EQ(json_violations(tree.path()),
            (Found{"server/api/a.cpp:2" + words, "server/api/a.cpp:3" + words, "server/api/a.cpp:5" + words,
                   "server/api/a.cpp:6" + words}));
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
      "#include <sodium.h>\n#include <boost/math/distributions/normal.hpp>\n";
  for (const char* room :
       {"gpu", "net", "ct", "geometry", "store", "renderer", "stream", "access", "statistics", "sim"})
    tree.write(std::string("server/") + room + "/a.cpp", all);
  const Found found = library_violations(tree.path());
  // 10 headers in 10 rooms, each allowed once; Beast and Asio share a room.
  EXPECT_EQ(found.size(), 100u - 10u) << lines(found);
  EXPECT_EQ(
      std::count(found.begin(), found.end(), "server/sim/a.cpp:4: itkImage.h: ITK belongs to ct, reader"), 1);
  for (const std::string& line : found) {
    const std::string room = line.substr(7, line.find('/', 7) - 7);
    EXPECT_FALSE(line.ends_with(" belongs to " + room)) << line;
  }
}

TEST(LayeringChecker, CountsLines) {
  const test::TemporaryFolder tree;
  tree.write("server/core/fits.hpp", std::string(250, '\n'));
  tree.write("server/core/fits.cpp", std::string(600, '\n'));
  tree.write("server/core/long.hpp", std::string(251, '\n'));
  tree.write("server/core/long.cpp", std::string(601, '\n'));
  tree.write("kernels/long.cl", std::string(601, '\n'));
  EXPECT_EQ(length_violations(tree.path()), (Found{"server/core/long.cpp:601: longer than 600 lines",
                                                   "server/core/long.hpp:251: longer than 250 lines",
                                                   "kernels/long.cl:601: longer than 600 lines"}));
}

TEST(LayeringChecker, NamesALongFunction) {
  const test::TemporaryFolder tree;
  tree.write("server/core/a.cpp",
             "int f() {\n" + std::string(78, '\n') + "}\n\nint g() {\n" + std::string(79, '\n') + "}\n");
  EXPECT_EQ(function_violations(tree.path()), Found{"server/core/a.cpp:82: a function of 81 lines"});
}

TEST(LayeringChecker, NamesCyclesOfFilesAndOfFolders) {
  const test::TemporaryFolder tree;
  tree.write("server/core/a.hpp", "#include \"core/b.hpp\"\n");
  tree.write("server/core/b.hpp", "#include \"core/a.hpp\"\n");
  tree.write("server/sim/c.hpp", "#include \"sim/parts/d.hpp\"\n#include \"core/a.hpp\"\n");
  tree.write("server/sim/parts/d.hpp", "");
  tree.write("server/sim/parts/e.cpp", "#include \"sim/f.hpp\"\n");
  tree.write("server/sim/f.hpp", "");
  EXPECT_EQ(file_cycles(tree.path()), Found{"server/core/a.hpp -> server/core/b.hpp -> server/core/a.hpp"});
  EXPECT_EQ(folder_cycles(tree.path()), Found{"server/sim -> server/sim/parts -> server/sim"});
}

TEST(LayeringChecker, NamesHeadersOfOneFunctionAndPrivateOnes) {
  const test::TemporaryFolder tree;
  tree.write("server/core/one.hpp", "namespace ream {\nint f(int a = g());\n}  // namespace ream\n");
  tree.write("server/core/two.hpp", "namespace ream {\nint f();\nint f(int a);\n}  // namespace ream\n");
  tree.write("server/core/noun.hpp",
             "namespace ream {\nstruct A {\n  int f();\n};\nA make();\n}  // namespace ream\n");
  tree.write("server/core/one.cpp",
             "#include \"core/one.hpp\"\n#include \"core/two.hpp\"\n#include \"core/noun.hpp\"\n");
  tree.write("server/sim/a.cpp", "#include \"core/one.hpp\"\n");
  tree.write("tests/unit/core/noun_test.cpp", "#include \"core/noun.hpp\"\n");
  EXPECT_EQ(single_function_headers(tree.path()), Found{"server/core/one.hpp"});
  EXPECT_EQ(private_headers(tree.path()),
            Found{"server/core/two.hpp: server/core/one.cpp alone includes it"});
}

}  // namespace
}  // namespace ream::layering
