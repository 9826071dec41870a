#include <algorithm>
#include <regex>
#include <sstream>

#include "core/file.hpp"
#include "e2e/cli/command_line.hpp"
#include "geometry/mesh_io.hpp"
#include "support/without_pictures.hpp"

namespace ream::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class SessionReport : public CommandLine {
 protected:
  void simulate(const std::string& script, const Words& more = {}) {
    Words words = {"simulate", "--case", "demo", "--script", script, "--out", "run", "--backend", "cpu"};
    words.insert(words.end(), more.begin(), more.end());
    succeed(words);
  }

  /// What a program of poppler says of a file.
  std::string poppler(const std::string& program, const Words& arguments) {
    Words command = {"/usr/bin/" + program};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const auto process = start_program(command, program);
    EXPECT_EQ(process->wait(std::chrono::seconds(60)), 0) << program;
    return printed(program + ".out");
  }

  /// Says what it says, and no number that is none.
  void expect_sound(const std::string& html) {
    EXPECT_FALSE(
        std::regex_search(without_pictures(html), std::regex("[^a-zA-Z](nan|inf|NaN|Infinity)[^a-zA-Z]")));
    EXPECT_TRUE(html.ends_with("</html>\n"));
  }
};

TEST_F(SessionReport, IsPrintableWithItsLettersAndPageNumbers) {
  simulate_short_demo();
  json session = json_of("run/session.json");
  session["trainee"] = "Zo\u00eb \u00d6zt\u00fcrk";
  write_file_atomically(folder() / "run/session.json", session.dump());
  succeed({"export", "run", "--out", "report.pdf"});
  const std::string file = (folder() / "report.pdf").string();
  const std::string text = poppler("pdftotext", {"-layout", file, "-"});
  for (const char* words : {"Glenoid reaming", "Zo\u00eb \u00d6zt\u00fcrk", "Page 1 of ", "Version achieved",
                            "retroversion", "theatre mode off", "Provenance", "\u2264"})
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
  const std::string fonts = poppler("pdffonts", {file});
  EXPECT_NE(fonts.find("yes"), std::string::npos);
  std::istringstream lines(fonts);
  for (std::string line; std::getline(lines, line);)
    if (line.find("Type") != std::string::npos && line.find("encoding") == std::string::npos) {
      EXPECT_TRUE(std::regex_search(line, std::regex("yes +yes +(yes|no)"))) << "not embedded: " << line;
    }
}

TEST_F(SessionReport, IsOnePageForTheBrowserToo) {
  simulate_short_demo();
  write("house.json", R"({"name": "House \u201cA\u201d", "version": 4, "pass_points": 10,
      "criteria": [{"metric": "duration_s", "none": 100, "full": 0}]})");
  succeed({"export", "run", "--out", "report.html", "--rubric", "house.json"});
  const std::string html = text_of("report.html");
  expect_sound(html);
  EXPECT_NE(html.find("House \u201cA\u201d\u201d, version 4"), std::string::npos);
  EXPECT_NE(html.find("Achieved against planned surface"), std::string::npos);
  EXPECT_NE(html.find("data:image/png"), std::string::npos);
}

TEST_F(SessionReport, OfASessionThatNeverTouchedBoneSaysSo) {
  take_demo_case();
  simulate(write("air.json", R"({"device": "hand", "duration_s": 1, "stiffness_n_mm": 100,
      "hand": {"start_mm": [0, 0, -40], "force_profile": [{"t_s": 0, "force_n": 0}]}})")
               .filename());
  succeed({"export", "run", "--out", "report.html"});
  succeed({"export", "run", "--out", "report.pdf"});
  const std::string html = text_of("report.html");
  expect_sound(html);
  EXPECT_NE(html.find("Not assessed"), std::string::npos);
  EXPECT_NE(html.find("no bone was removed"), std::string::npos);
  EXPECT_NE(html.find("Nothing was cut."), std::string::npos);
  const json told = answer({"score", "run"});
  EXPECT_EQ(told.at("score").at("outcome"), "undecided");
}

TEST_F(SessionReport, OfAFewMomentsIsAReport) {
  take_demo_case();
  simulate(write("moment.json", R"({"device": "hand", "duration_s": 0.02, "stiffness_n_mm": 100,
      "hand": {"start_mm": [0, 0, -1], "force_profile": [{"t_s": 0, "force_n": 60}]}})")
               .filename());
  succeed({"export", "run", "--out", "report.html"});
  succeed({"export", "run", "--out", "report.pdf"});
  expect_sound(text_of("report.html"));
}

TEST_F(SessionReport, WithoutItsCaseSaysWhatItCannotShow) {
  simulate_short_demo();
  fs::rename(folder() / "data/cases/demo", folder() / "elsewhere");
  json changed = json_of("elsewhere/case.json");
  changed["name"] = "Another";
  fs::create_directories(folder() / "data/cases");
  succeed({"export", "run", "--out", "there.html", "--case", (folder() / "elsewhere").string()});
  EXPECT_NE(text_of("there.html").find("data:image/png"), std::string::npos);
  // The demo case is made again; its bone is the same, so that this works too. A case that is not there does
  // not.
  json session = json_of("run/session.json");
  refuse(1, "nowhere", {"export", "run", "--out", "no.ply", "--case", (folder() / "nowhere").string()});
  succeed({"export", "run", "--out", "report.html", "--case", (folder() / "nowhere").string()});
  const std::string html = text_of("report.html");
  expect_sound(html);
  EXPECT_NE(html.find("There are no pictures"), std::string::npos);
  EXPECT_EQ(html.find("data:image/png"), std::string::npos);
}

TEST_F(SessionReport, SurfacesGoToOtherProgramsInTheirUnits) {
  simulate_short_demo();
  for (const char* name : {"again.stl", "again.glb", "again.ply", "deviation.json"})
    succeed({"export", "run", "--out", name});
  succeed({"export", "run", "--out", "implant.stl", "--format", "implant"});
  succeed({"export", "run", "--out", "surface.ply", "--format", "surface"});
  EXPECT_EQ(text_of("surface.ply"), text_of("run/reamed.ply"));
  const TriangleMesh reamed = load_mesh(folder() / "run/reamed.ply");
  const TriangleMesh stl = load_mesh(folder() / "again.stl");
  EXPECT_EQ(stl.triangles.size(), reamed.triangles.size());
  EXPECT_NEAR(stl.volume_mm3(), reamed.volume_mm3(), 1e-4 * reamed.volume_mm3());
  EXPECT_TRUE(text_of("again.stl").starts_with("reamed bone, millimetres, LPS, right shoulder"));
  const TriangleMesh implant = load_mesh(folder() / "implant.stl");
  EXPECT_LT((implant.bounds().centre() - reamed.bounds().centre()).norm(), 60.0);
  const TriangleMesh both = load_mesh(folder() / "again.ply");
  EXPECT_EQ(both.triangles.size(), reamed.triangles.size() + implant.triangles.size());
  const std::string header = text_of("again.ply").substr(0, 800);
  EXPECT_NE(header.find("property char deviation_plan"), std::string::npos) << header;
  EXPECT_NE(header.find("property char deviation_implant"), std::string::npos) << header;
  const TriangleMesh glb = load_mesh(folder() / "again.glb");
  EXPECT_NEAR(glb.volume_mm3() * 1e9, both.volume_mm3(), 1e-3 * both.volume_mm3()) << "glTF is in metres";
  const json deviation = json_of("deviation.json");
  EXPECT_EQ(deviation.at("vertices"), reamed.vertices_mm.size());
  EXPECT_EQ(fs::file_size(folder() / "deviation.bin"), 3 * reamed.vertices_mm.size())
      << "plan, implant and wall";
}

TEST_F(SessionReport, OtherEndingsAreRefusedWithThoseThereAre) {
  simulate_short_demo();
  refuse(2, ".pdf (report for printing)", {"export", "run", "--out", "report.docx"});
  refuse(2, "implant, surface", {"export", "run", "--out", "a.stl", "--format", "bone"});
  refuse(2, "for reports", {"export", "run", "--out", "a.csv", "--rubric", "standard"});
}

TEST_F(SessionReport, HasAPageOfAComponentUnderLoad) {
  simulate_short_demo();
  succeed({"export", "run", "--out", "report.pdf", "--component-load"});
  const std::string text = poppler("pdftotext", {"-layout", (folder() / "report.pdf").string(), "-"});
  for (const char* words :
       {"Component under load", "750", "Before", "As planned", "As reamed", "Micromotion index"})
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
  const json load = answer({"solve", "run", "--component", "--cell-mm", "2"});
  ASSERT_EQ(load.at("states").size(), 3u);
  for (const json& state : load.at("states")) {
    EXPECT_EQ(state.at("loads").size(), 5u);
    EXPECT_GT(state.at("motion_um"), 0.0);
    EXPECT_GT(state.at("supported_percent"), 0.0);
  }
  EXPECT_GT(load.at("states")[1].at("supported_percent"), load.at("states")[0].at("supported_percent"))
      << "the plan's reaming supports the component";
  refuse(2, "are for reports", {"export", "run", "--out", "bone.stl", "--component-load"});
  refuse(1, "no session", {"solve", "demo", "--component"});
  refuse(2, "--cell-mm", {"solve", "run", "--component", "--cell-mm", "0"});
}

}  // namespace
}  // namespace ream::test
