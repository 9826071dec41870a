#include <signal.h>
#include <sys/resource.h>

#include <thread>

#include "e2e/cli/command_line.hpp"

namespace ream::test {
namespace {

class Voxelize : public CommandLine {
 protected:
  Voxelize() {
    write("box.off",
          "OFF\n8 6 12\n0 0 0\n4 0 0\n0 3 0\n4 3 0\n0 0 2\n4 0 2\n0 3 2\n4 3 2\n"
          "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n");
  }
};

TEST_F(Voxelize, SolidsOfBothBackendsAndBothStoresAreTheVolume) {
  for (const char* backend : {"cpu", "opencl"})
    for (const char* memory_mb : {"0", "1024"}) {
      const auto answered = answer({"voxelize", "box.off", "--size", "0.1,0.1,0.2", "--solid", "--backend",
                                    backend, "--memory-mb", memory_mb});
      EXPECT_EQ(answered.at("voxels"), 40 * 30 * 10) << backend << ' ' << memory_mb;
      EXPECT_EQ(answered.at("kept_as"), std::string(memory_mb) == "0" ? "bricks" : "bits");
    }
}

TEST_F(Voxelize, WritesEveryKindOfFileAndGridsLikeOthers) {
  const auto first =
      answer({"voxelize", "box.off", "--size", "0.25", "--scale", "2", "--grid", "grid.nrrd", "--bits",
              "--points", "points.ply", "--morton", "codes.nrrd", "--boxes", "boxes.ply"});
  for (const char* file : {"grid.nrrd", "points.ply", "codes.nrrd", "boxes.ply"})
    EXPECT_GT(std::filesystem::file_size(folder() / file), 1000u) << file;
  const auto like = answer({"voxelize", "box.off", "--like", "grid.nrrd", "--scale", "2"});
  EXPECT_EQ(like.at("dims"), first.at("dims"));
  EXPECT_EQ(like.at("voxels"), first.at("voxels"));
}

TEST_F(Voxelize, BadInputIsOneLineAndLeavesNothing) {
  refuse(2, "--size", {"voxelize", "box.off", "--size", "0"});
  refuse(2, "--size", {"voxelize", "box.off", "--size", "-1"});
  refuse(2, "--size", {"voxelize", "box.off", "--size", "1,2"});
  refuse(2, "--size", {"voxelize", "box.off", "--size", "nan"});
  refuse(2, "--scale", {"voxelize", "box.off", "--size", "1", "--scale", "0"});
  refuse(2, "--size or --like", {"voxelize", "box.off"});
  refuse(2, "same.ply",
         {"voxelize", "box.off", "--size", "1", "--points", "same.ply", "--boxes", "same.ply"});
  refuse(1, "2^40", {"voxelize", "box.off", "--size", "1e-5", "--points", "p.ply"});
  refuse(1, "nowhere.stl", {"voxelize", "nowhere.stl", "--size", "1"});
  refuse(1, "no/where", {"voxelize", "box.off", "--size", "1", "--grid", "no/where.nrrd"});
  write("nan.off", "OFF\n3 1 0\n0 0 0\nnan 1 0\n0 1 0\n3 0 1 2\n");
  refuse(1, "nan.off", {"voxelize", "nan.off", "--size", "1"});
  write("index.off", "OFF\n3 1 0\n0 0 0\n1 1 0\n0 1 0\n3 0 1 7\n");
  refuse(1, "vertex that does not exist", {"voxelize", "index.off", "--size", "1"});
  write("cut.off", "OFF\n3 1 0\n0 0 0\n1 1 0\n");
  refuse(1, "cut off", {"voxelize", "cut.off", "--size", "1"});
  write("open.off", "OFF\n3 1 0\n0 0 0\n1 1 0\n0 1 0\n3 0 1 2\n");
  refuse(1, "not closed", {"voxelize", "open.off", "--size", "1", "--solid", "--points", "p.ply"});
  refuse(1, "box.off", {"voxelize", "box.off", "--like", "box.off"});
}

TEST_F(Voxelize, AFullDiskIsOneLineAndLeavesNothing) {
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 200000;
  ::setrlimit(RLIMIT_FSIZE, &small);
  refuse(1, "grid.nrrd",
         {"voxelize", "box.off", "--size", "0.02", "--grid", "grid.nrrd", "--points", "points.ply"});
  ::setrlimit(RLIMIT_FSIZE, &before);
}

TEST_F(Voxelize, AnInterruptedRunLeavesNothing) {
  const std::vector<std::string> files = tree();
  const auto running =
      start({"voxelize", "box.off", "--size", "0.004", "--solid", "--grid", "grid.nrrd"}, "long");
  // The output is begun once the mesh has been read.
  for (int i = 0; i < 3000 && tree() == files; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  running->send_signal(SIGINT);
  EXPECT_EQ(running->wait(std::chrono::seconds(60)), 1);
  EXPECT_EQ(printed("long.err"), "ream: interrupted; nothing was written\n");
  EXPECT_EQ(tree(), files);
}

}  // namespace
}  // namespace ream::test
