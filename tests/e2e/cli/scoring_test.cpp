#include <cstring>
#include <regex>

#include "core/file.hpp"
#include "e2e/cli/command_line.hpp"
#include "support/without_pictures.hpp"

namespace ream::test {
namespace {

using nlohmann::json;

/// Sessions of which little can be said: score and report say what cannot be, and hold no number that is
/// none.
class Scoring : public CommandLine {
 protected:
  /// A block of bone, 12 x 12 x 6 mm, of which nobody knows what it is: no landmarks, planned by an axis.
  void make_block() {
    constexpr int n = 48, rim = 12, top = 12, bottom = 24, depth_voxels = 36;
    std::string volume =
        "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 48 48 36\n"
        "space directions: (0.5,0,0) (0,0.5,0) (0,0,0.5)\nkinds: domain domain domain\nendian: little\n"
        "encoding: raw\nspace origin: (0,0,0)\n\n";
    for (int z = 0; z < depth_voxels; ++z)
      for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
          const bool inside = x >= rim && x < n - rim && y >= rim && y < n - rim && z >= top && z < bottom;
          const int16_t hu = inside ? 700 : -1000;
          char bytes[2];
          std::memcpy(bytes, &hu, 2);
          volume.append(bytes, 2);
        }
    write("block.nrrd", volume);
    answer({"import", "block.nrrd", "--out", "block", "--side", "left", "--threshold-hu", "150"});
    answer({"plan", "block", "--axis", "11.75,11.75,5.75,0,0,1", "--depth-mm", "1", "--reamer", "convex-40"});
  }

  /// A hand that pushes, through easily cut bone.
  void simulate(const std::string& case_name, double duration_s, double force_n, double start_mm) {
    const json script = {
        {"device", "hand"},
        {"duration_s", duration_s},
        {"stiffness_n_mm", 100},
        {"specimen_factor", 10},
        {"hand", {{"start_mm", {0, 0, start_mm}}, {"force_profile", {{{"t_s", 0}, {"force_n", force_n}}}}}}};
    run_script(case_name, script);
  }
  void run_script(const std::string& case_name, const json& script) {
    write("push.json", script.dump());
    succeed({"simulate", "--case", case_name, "--script", "push.json", "--out", "run", "--backend", "cpu"});
  }

  /// Every metric is a number or has its reason; so have score, report and table. Returns the score.
  json expect_sound() {
    const json told = answer({"score", "run", "--csv", "scores.csv"});
    EXPECT_EQ(told.at("metrics"), json_of("run/metrics.json"));
    const json& missing = told.at("metrics").at("missing");
    for (const auto& [key, value] : told.at("metrics").items())
      if (value.is_null()) {
        EXPECT_FALSE(missing.value(key, "").empty()) << key;
      }
    for (const auto& [key, reason] : missing.items())
      EXPECT_TRUE(told.at("metrics").at(key).is_null()) << key;
    for (const char* name : {"report.html", "report.pdf"}) succeed({"export", "run", "--out", name});
    const std::regex no_number("[^a-zA-Z](nan|inf|NaN|Infinity)[^a-zA-Z]");
    EXPECT_FALSE(std::regex_search(without_pictures(text_of("report.html")), no_number));
    EXPECT_FALSE(std::regex_search(text_of("scores.csv"), no_number));
    EXPECT_FALSE(std::regex_search(succeed({"score", "run"}).out, no_number));
    return told;
  }
  static std::string reason(const json& told, const char* metric) {
    return told.at("metrics").at("missing").value(metric, "");
  }
};

TEST_F(Scoring, OfWhatNeverTouchedBone) {
  take_demo_case();
  simulate("demo", 1.0, 0.0, -40.0);
  const json told = expect_sound();
  EXPECT_EQ(told.at("score").at("outcome"), "undecided");
  EXPECT_EQ(told.at("metrics").at("removed_volume_mm3"), 0.0);
  for (const char* metric :
       {"version_achieved_deg", "seating_percent", "medialization_mm", "vault_breach_mm"})
    EXPECT_EQ(reason(told, metric), "no bone was removed") << metric;
  EXPECT_TRUE(told.at("metrics").at("version_planned_deg").is_number());
  EXPECT_NE(text_of("report.html").find("Not assessed"), std::string::npos);
}

TEST_F(Scoring, OfTheFirstMoments) {
  take_demo_case();
  simulate("demo", 0.001, 60.0, -1.0);
  const json told = expect_sound();
  EXPECT_EQ(told.at("score").at("outcome"), "undecided");
  EXPECT_EQ(told.at("metrics").at("duration_s"), 0.001);
}

TEST_F(Scoring, OfACaseWithoutLandmarks) {
  make_block();
  simulate("block", 0.5, 60.0, -1.0);
  const json told = expect_sound();
  EXPECT_GT(told.at("metrics").at("removed_volume_mm3").get<double>(), 1.0);
  for (const char* metric : {"version_planned_deg", "version_achieved_deg", "version_error_deg",
                             "retroversion_achieved_deg", "inclination_achieved_deg", "plan_correction_deg"})
    EXPECT_NE(reason(told, metric).find("landmarks"), std::string::npos) << metric << reason(told, metric);
  EXPECT_LT(told.at("metrics").at("axis_error_deg").get<double>(), 0.2) << "needs no landmarks";
}

/// The reamer goes through and leaves slivers at the corners.
TEST_F(Scoring, OfBoneThatIsAllButGone) {
  make_block();
  // So far beyond the block that the cap has all but reached its corners.
  run_script(
      "block",
      {{"device", "poses"},
       {"duration_s", 8},
       {"stiffness_n_mm", 100},
       {"specimen_factor", 10},
       {"poses", {{{"t_s", 0}, {"position_mm", {0, 0, -1}}}, {{"t_s", 6}, {"position_mm", {0, 0, 6.45}}}}}});
  const json told = expect_sound();
  constexpr double hole_mm3 = 3.14159 * 3.1 * 3.1 * 6.0;
  const double removed_mm3 = told.at("metrics").at("removed_volume_mm3").get<double>();
  EXPECT_NEAR(removed_mm3, 12 * 12 * 6.0 - hole_mm3, 0.03 * 864.0);
  EXPECT_EQ(told.at("score").at("outcome"), "fail");
  EXPECT_LT(told.at("metrics").at("seating_percent").get<double>(), 10.0);
  EXPECT_EQ(told.at("metrics").at("plate_preserved_percent"), 0.0);
  EXPECT_NE(reason(told, "congruity_mm").find("too small"), std::string::npos) << "slivers have no shape";
  for (const char* name : {"a.ply", "a.stl", "a.glb", "a.json"}) succeed({"export", "run", "--out", name});
}

}  // namespace
}  // namespace ream::test
