#include "e2e/cli/command_line.hpp"

namespace ream::test {
namespace {

namespace fs = std::filesystem;

class BadInput : public CommandLine {
 protected:
  /// Arguments of a run of the demo case that would be fine without `more`.
  Words demo_run(const Words& more) {
    Words arguments = {"simulate", "--case", "demo", "--script", short_script(), "--out", "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
};

TEST_F(BadInput, OptionsThatAreNotThereAreUsage) {
  refuse(2, "--bogus", {"simulate", "--case", "demo", "--script", "demo", "--bogus"});
  refuse(2, "did you mean '--case'?", {"simulate", "--cse", "demo"});
  refuse(2, "did you mean 'simulate'?", {"simualte", "--case", "demo"});
  const Outcome for_programs = run({"--json", "simulate", "--cse", "demo"});
  EXPECT_EQ(for_programs.exit_code, 2);
  EXPECT_EQ(nlohmann::json::parse(for_programs.error),
            nlohmann::json(
                {{"error", "no option '--cse' of ream simulate; did you mean '--case'?"}, {"exit_code", 2}}));
  refuse(2, "--case", {"simulate", "--script", "demo"});
  refuse(2, "subcommand", {});
  refuse(2, "--format", {"phantom", "--out", "p", "--format", "jpeg"});
  refuse(2, "--spacing-mm", {"phantom", "--out", "p", "--spacing-mm", "0"});
  refuse(2, "--removal", {"simulate", "--case", "demo", "--script", "demo", "--removal", "dynamite"});
  refuse(2, "0.001", {"simulate", "--case", "demo", "--script", "demo", "--tool-spacing-mm", "0.001"});
  refuse(2, "--tool-axis", {"simulate", "--case", "demo", "--script", "demo", "--tool-axis", "1,2,3"});
  refuse(2, "--roi", {"import", "anything", "--out", "a", "--roi", "1,2,3"});
}

TEST_F(BadInput, WhatIsNoCtIsNotImported) {
  refuse(1, "nowhere", {"import", "nowhere", "--out", "a"});
  write("empty/readme.txt", "nothing to see");
  refuse(1, "empty", {"import", "empty", "--out", "a"});
  refuse(1, "readme.txt", {"import", "empty/readme.txt", "--out", "a"});
}

TEST_F(BadInput, CutOffVolumesAndRegionsOfNoSizeAreNotImported) {
  succeed({"phantom", "--out", "phantom", "--spacing-mm", "1.5", "--format", "nrrd"});
  refuse(1, "no volume", {"import", "phantom/ct.nrrd", "--out", "a", "--roi", "1,2,3,1,2,3"});
  refuse(1, "region", {"import", "phantom/ct.nrrd", "--out", "a", "--roi", "900,900,900,950,950,950"});
  refuse(1, "not empty", {"phantom", "--out", "phantom", "--spacing-mm", "1.5"});
  refuse(1, "phantom/ct.nrrd/p", {"phantom", "--out", "phantom/ct.nrrd/p", "--spacing-mm", "1.5"});
  refuse(1, "phantom/ct.nrrd/a",
         {"import", "phantom/ct.nrrd", "--out", "./phantom/ct.nrrd/a", "--side", "right"});
  const std::string whole = text_of("phantom/ct.nrrd");
  for (const size_t bytes : {size_t{0}, size_t{40}, size_t{1000}, whole.size() / 2, whole.size() - 1}) {
    write("cut.nrrd", whole.substr(0, bytes));
    refuse(1, "cut.nrrd", {"import", "cut.nrrd", "--out", "a"});
  }
  std::string damaged = whole;
  damaged[whole.size() / 2] = static_cast<char>(damaged[whole.size() / 2] ^ 0x40);
  write("damaged.nrrd", damaged);
  refuse(1, "damaged.nrrd", {"import", "damaged.nrrd", "--out", "a"});
}

TEST_F(BadInput, UnusableScriptsCasesAndPlacesAreNamed) {
  const std::string script = short_script();
  write("unknown_key.json", R"({"device": "poses", "durtion_s": 1, "duration_s": 1, "poses": [{"t_s": 0}]})");
  write("late.json", R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 1}, {"t_s": 1}]})");
  write("broken.json", R"({"device": )");
  const auto run_with = [](const std::string& which, const std::string& a_case = "demo",
                           const std::string& out = "out") {
    return Words{"simulate", "--case", a_case, "--script", which, "--out", out};
  };
  refuse(1, "'durtion_s'", run_with("unknown_key.json"));
  refuse(1, "poses[1]", run_with("late.json"));
  refuse(1, "broken.json", run_with("broken.json"));
  refuse(1, "nothing.json", run_with("nothing.json"));
  refuse(1, "nobody", run_with(script, "nobody"));
  refuse(1, "short.json/out", run_with(script, "demo", "short.json/out"));
  write("full/file", "mine");
  refuse(1, "full", run_with(script, "demo", "full"));
  EXPECT_EQ(text_of("full/file"), "mine");
  refuse(1, "short.json", run_with(script, "demo", "short.json"));
  refuse(1, "nobody", {"plan", "nobody"});
}

TEST_F(BadInput, UnusableToolsAndBackendsAreNamed) {
  take_demo_case();
  write(
      "nan.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\nnan 1 0\n0 0 1\n3 0 1 2\n");
  write("empty.stl", "solid empty\nendsolid empty\n");
  short_script();
  refuse(1, "nan.ply", demo_run({"--tool", "nan.ply"}));
  refuse(1, "empty.stl", demo_run({"--tool", "empty.stl"}));
  refuse(1, "missing.stl", demo_run({"--tool", "missing.stl"}));
  refuse(2, "cube 3", demo_run({"--tool", "cube 3"}));
  refuse(2, "sphere -3", demo_run({"--tool", "sphere -3"}));
  refuse(1, "spacing", demo_run({"--tool", "ellipse 25,10", "--tool-spacing-mm", "0.02"}));
  refuse(2, "turbo", demo_run({"--backend", "turbo"}));
  refuse(2, "opencl:99", demo_run({"--backend", "opencl:99"}));
  refuse(1, "nan.ply", {"voxelize", "nan.ply", "--size", "1"});
  refuse(2, "--size", {"voxelize", "nan.ply", "--size", "0"});
  refuse(2, "cube", {"plan", "demo", "--reamer", "cube"});
  refuse(1, "missing.stl", {"plan", "demo", "--reamer", "missing.stl"});
  refuse(1, "depth_mm", {"plan", "demo", "--depth-mm", "-3"});
}

}  // namespace
}  // namespace ream::test
