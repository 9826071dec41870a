#include <signal.h>

#include <fstream>
#include <thread>

#include "e2e/cli/command_line.hpp"
#include "support/places.hpp"

namespace ream::test {
namespace {

class Femesh : public CommandLine {
 protected:
  /// Text rows of a block, x fastest.
  std::string rows(int edge) {
    std::string text;
    for (int i = 0; i < edge * edge * edge; ++i)
      text += std::to_string(0.5 * (i % edge)) + " " + std::to_string(0.5 * (i / edge % edge)) + " " +
              std::to_string(0.5 * (i / edge / edge)) + " " + std::to_string(100 + i % 7) + "\n";
    return write("rows.txt", text);
  }
};

TEST_F(Femesh, TextRowsBecomeAMeshThatIsChecked) {
  rows(10);
  const auto made =
      answer({"femesh", "rows.txt", "--out", "mesh.inp", "--modulus", "0,10", "--bins", "20", "--check"});
  EXPECT_EQ(made["elements"], 1000);
  EXPECT_EQ(made["nodes"], 1331);
  EXPECT_EQ(made["materials"], 4);
  EXPECT_GT(made["time_ms"], 0.0);
  EXPECT_GT(made["peak_memory_mb"], 0.0);
  const auto read = answer({"femesh", "mesh.inp", "--check"});
  EXPECT_EQ(read["elements"], 1000);
  EXPECT_EQ(read["volume_mm3"], made["volume_mm3"]);
  EXPECT_EQ(answer({"femesh", "rows.txt", "--out", "mesh.vtu", "--upsample", "2", "--check"})["elements"],
            8000);
}

TEST_F(Femesh, BoneIsCompressed) {
  rows(8);
  const auto solved = answer({"solve", "rows.txt", "--modulus", "0,10", "--axis", "y"});
  EXPECT_EQ(solved["elements"], 512);
  EXPECT_EQ(solved["converged"], true);
  EXPECT_GT(solved["modulus_mpa"], solved["reuss_mpa"]);
  EXPECT_LT(solved["modulus_mpa"], solved["voigt_mpa"]);
  EXPECT_EQ(answer({"solve", "rows.txt", "--modulus", "0,10", "--axis", "y", "--threads", "1"})["force_n"],
            solved["force_n"]);
  const auto on_device =
      answer({"solve", "rows.txt", "--modulus", "0,10", "--axis", "y", "--backend", "opencl"});
  EXPECT_EQ(on_device["force_n"], solved["force_n"]);
  EXPECT_EQ(on_device["backend"].get<std::string>().substr(0, 8), "opencl: ");
  EXPECT_EQ(answer({"solve", "rows.txt", "--upsample", "2", "--modulus", "0,10"})["elements"], 4096);
  refuse(1, "not converged after 1 iterations",
         {"solve", "rows.txt", "--modulus", "0,10", "--max-iterations", "1", "--platens", "fixed",
          "--tolerance", "1e-8"});
  refuse(1, "nowhere", {"solve", "nowhere"});
  refuse(2, "--axis", {"solve", "rows.txt", "--axis", "w"});
  refuse(2, "--backend 'gpu'", {"solve", "rows.txt", "--backend", "gpu"});
  refuse(2, "no OpenCL device 'opencl:99'", {"solve", "rows.txt", "--backend", "opencl:99"});
  refuse(1, "no voxel is bone", {"solve", "rows.txt", "--modulus", "0,10", "--threshold", "5000"});
}

TEST_F(Femesh, TextRowsAsMimicsWritesThem) {
  std::string text;
  for (int i = 0; i < 4 * 4 * 4; ++i) {
    char row[100];
    std::snprintf(row, sizeof row, "+%d.83437000E+001, +%d.28356900E+002, -%d.00000000E+001,    %+d\r\n",
                  1 + i % 4, 1 + i / 4 % 4, 1 + i / 16, 327 - i);
    text += row;
  }
  write("mimics.txt", text);
  const auto made = answer(
      {"femesh", "mimics.txt", "--out", "mesh.inp", "--modulus", "0,10", "--threshold", "300", "--check"});
  EXPECT_EQ(made["elements"], 28);  // 327 down to 300
  EXPECT_NEAR(made["volume_mm3"], 28 * 10.0 * 100.0 * 10.0, 1e-3);
}

TEST_F(Femesh, VolumesOfEveryKindAreTheSameMesh) {
  for (const std::string format : {"nrrd", "nifti", "dicom"})
    succeed({"phantom", "--out", format, "--spacing-mm", "2", "--format", format, "--random-seed", "5"});
  const Words law = {"--threshold", "300", "--modulus", "0,10", "--bins", "500", "--check"};
  std::vector<nlohmann::json> meshes;
  for (const std::string source : {"nrrd/ct.nrrd", "nifti/ct.nii.gz", "dicom"}) {
    Words words = {"femesh", source, "--out", "mesh.inp"};
    words.insert(words.end(), law.begin(), law.end());
    meshes.push_back(answer(words));
    EXPECT_GT(meshes.back()["elements"], 1000) << source;
  }
  for (const auto& mesh : meshes)
    for (const char* key : {"elements", "nodes", "materials", "islands"})
      EXPECT_EQ(mesh[key], meshes[0][key]) << key;
}

/// CT to reamed bone to finite elements: the session's mesh has lost what was reamed.
TEST_F(Femesh, ASessionIsTheBoneThatItLeft) {
  simulate_short_demo();
  const auto before = answer({"femesh", "demo", "--out", "before.inp", "--keep-islands", "--check"});
  const auto after = answer({"femesh", "run", "--out", "after.inp", "--keep-islands", "--check"});
  const double removed_mm3 = json_of("run/metrics.json")["removed_volume_mm3"];
  ASSERT_GT(removed_mm3, 0.0);
  EXPECT_LT(after["elements"], before["elements"]);
  EXPECT_GT(after["modulus_min_mpa"], 0.0);
  // Beside what was reamed, only the pilot hole is missing: 6.2 mm wide and at most 12 mm deep. A voxel goes
  // when half of it has gone, so that a thin cut may count less or more.
  const double lost_mm3 = before["volume_mm3"].get<double>() - after["volume_mm3"].get<double>();
  EXPECT_LT(lost_mm3, 2.0 * removed_mm3 + 3.1416 * 3.1 * 3.1 * 12.0 * 1.1);
}

TEST_F(Femesh, WhatCannotBeMeshedIsNamed) {
  rows(4);
  const Words out = {"--out", "mesh.inp"};
  const auto refuse_rows = [&](int code, const std::string& mentioned, Words more) {
    Words words = {"femesh", "rows.txt", "--out", "mesh.inp"};
    words.insert(words.end(), more.begin(), more.end());
    refuse(code, mentioned, words);
  };
  refuse(1, "nowhere", {"femesh", "nowhere", "--out", "mesh.inp"});
  refuse(2, "--out", {"femesh", "rows.txt"});
  refuse(2, ".inp", {"femesh", "rows.txt", "--out", "mesh.stl"});
  refuse(1, "no-such", {"femesh", "rows.txt", "--out", "no-such/mesh.inp", "--modulus", "1,1"});
  refuse_rows(1, "E = ", {"--modulus", "-200,1"});
  refuse_rows(1, "no voxel is bone", {"--threshold", "1000", "--modulus", "1,1"});
  refuse_rows(2, "--modulus", {"--modulus", "1"});
  refuse_rows(2, "hooke", {"--law", "hooke"});
  refuse_rows(2, "Poisson", {"--modulus", "1,1", "--poisson", "0.5"});
  refuse_rows(2, "--upsample", {"--upsample", "0"});
  refuse_rows(2, "bins", {"--modulus", "1,1", "--bins", "0"});
  std::ofstream(folder() / "rows.txt", std::ios::app) << "0.75 0 0 1\n";
  refuse_rows(1, "line 65", {"--modulus", "1,1"});
  rows(4);
  std::ofstream(folder() / "rows.txt", std::ios::app) << "0.5 0 0 1\n";
  refuse_rows(1, "line 65", {"--modulus", "1,1"});
}

TEST_F(Femesh, AnAdministratorsLimitOfFilesHoldsForTheReader) {
  rows(40);
  const std::string command = build_folder() + "/ream femesh rows.txt --modulus 1,1 --out mesh.inp";
  EXPECT_EQ(start_program({"/bin/sh", "-c", "ulimit -f 40000; exec " + command}, "limited")
                ->wait(std::chrono::seconds(60)),
            0)
      << printed("limited.err");
  EXPECT_EQ(start_program({"/bin/sh", "-c", "ulimit -f 20; exec " + command}, "little")
                ->wait(std::chrono::seconds(60)),
            1);
  EXPECT_NE(printed("little.err").find("rows.txt cannot be read: what is in it is larger than is taken"),
            std::string::npos)
      << printed("little.err");
}

TEST_F(Femesh, AFullDiskLeavesNothingBehind) {
  rows(40);
  const auto before = tree();
  const std::string command = build_folder() + "/ream femesh rows.txt --modulus 1,1 --out mesh.inp";
  EXPECT_EQ(start_program({"/bin/sh", "-c", "ulimit -S -f 200; exec " + command}, "full")
                ->wait(std::chrono::seconds(60)),
            1);
  EXPECT_NE(printed("full.err").find("cannot write mesh.inp"), std::string::npos) << printed("full.err");
  EXPECT_EQ(tree(), before);
}

TEST_F(Femesh, AnInterruptLeavesNothingBehindAndTheOldFileAlone) {
  rows(100);
  write("mesh.inp", "old");
  const auto before = tree();
  const auto program =
      start({"femesh", "rows.txt", "--modulus", "1,1", "--upsample", "4", "--out", "mesh.inp"}, "cut");
  for (int i = 0; i < 2000 && tree() == before && !program->ended(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  program->send_signal(SIGINT);
  EXPECT_EQ(program->wait(std::chrono::seconds(60)), 1);
  EXPECT_NE(printed("cut.err").find("interrupted"), std::string::npos) << printed("cut.err");
  EXPECT_EQ(tree(), before);
  EXPECT_EQ(text_of("mesh.inp"), "old");
}

}  // namespace
}  // namespace ream::test
