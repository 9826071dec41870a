#include "session/scoring/rescoring.hpp"

#include <gtest/gtest.h>

#include "case/landmarks.hpp"
#include "core/data_folder.hpp"
#include "core/file.hpp"
#include "session/live/headless_run.hpp"
#include "session/simulation/session_setup.hpp"
#include "support/analytic_glenoid.hpp"
#include "support/temporary_folder.hpp"

namespace ream::session {
namespace {

using nlohmann::json;

/// A case and three sessions on it, of which the last took another reamer.
class RescoringTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_.emplace();
    const test::AnalyticGlenoid glenoid;
    case_::Case c;
    c.id = c.name = "glenoid";
    c.bone = test::bone_of(glenoid, 0.8);
    case_::Plan plan;
    plan.entry_mm = glenoid.frame().centre;
    plan.axis_direction = -glenoid.frame().n;
    plan.reamer = "sphere 30,10";
    c.plan = plan;
    case_::save_case(c, cases_folder(data()) / "glenoid");
    case_::save_landmarks(test::shoulder_landmarks(glenoid.shoulder), cases_folder(data()) / "glenoid");
    ream("one", {});
    std::filesystem::copy(sessions_folder(data()) / "one", sessions_folder(data()) / "two");
    ream("three", "sphere 26,8");
  }

  static void TearDownTestSuite() { folder_.reset(); }

  static const std::filesystem::path& data() { return folder_->path(); }

  static void ream(const std::string& id, const std::string& tool) {
    const json script = {{"device", "hand"},
                         {"duration_s", 1.0},
                         {"stiffness_n_mm", 100.0},
                         {"specimen_factor", 6.0},
                         {"hand",
                          {{"start_mm", {0.3, -0.2, -2.0}},
                           {"force_profile", json::array({{{"t_s", 0.0}, {"force_n", 40.0}}})}}}};
    write_file_atomically(data() / "script.json", script.dump());
    RunRequest request;
    request.case_name = "glenoid";
    request.script_name = (data() / "script.json").string();
    request.backend = "cpu";
    request.tool = tool;
    request.tool_spacing_mm = 1.0;
    Simulation simulation(build_setup(request, data()));
    const std::filesystem::path folder = sessions_folder(data()) / id;
    std::filesystem::create_directories(folder);
    const std::vector<uint8_t> start = simulation.bone_case.bone.coverage;
    run_headless(simulation, start, folder, false);
  }

 private:
  inline static std::optional<test::TemporaryFolder> folder_;
};

const std::vector<std::string> all_names{"one", "three", "two", "no such session", "one"};

TEST_F(RescoringTest, GivesWhatEachSessionGaveWhenItEnded) {
  const std::vector<Rescored> all = rescore(all_names, {}, data(), no_progress);
  ASSERT_EQ(all.size(), 5u);
  for (const Rescored& one : all) {
    if (one.name == "no such session") {
      EXPECT_EQ(one.kind, ErrorKind::not_found);
      EXPECT_FALSE(one.error.empty());
      continue;
    }
    EXPECT_EQ(one.error, "");
    EXPECT_EQ(one.metrics, read_json_file(sessions_folder(data()) / one.name / "metrics.json")) << one.name;
    EXPECT_TRUE(one.metrics.at("seating_percent").is_number());
  }
  EXPECT_NE(all[0].metrics, all[1].metrics);
}

TEST_F(RescoringTest, ACaseThatIsGoneIsSaidWithoutPlacesOfThisMachine) {
  const test::TemporaryFolder other;
  std::filesystem::create_directories(sessions_folder(other.path()));
  std::filesystem::copy(sessions_folder(data()) / "one", sessions_folder(other.path()) / "one");
  const std::vector<Rescored> all = rescore(std::vector<std::string>{"one"}, {}, other.path(), no_progress);
  EXPECT_EQ(all.at(0).error, "");
  const json& metrics = all.at(0).metrics;
  EXPECT_TRUE(metrics.at("seating_percent").is_null());
  const std::string reason = metrics.at("missing").at("seating_percent");
  EXPECT_NE(reason.find("case"), std::string::npos) << reason;
  EXPECT_EQ(reason.find('/'), std::string::npos) << reason;
}

TEST_F(RescoringTest, ReportsProgress) {
  double before = 0.0;
  std::vector<std::string> named;
  rescore(all_names, {}, data(), [&](double share, std::string_view name) {
    EXPECT_GE(share, before);
    EXPECT_LE(share, 1.0 + 1e-12);
    before = share;
    if (named.empty() || named.back() != name) named.emplace_back(name);
  });
  EXPECT_NEAR(before, 1.0, 1e-12);
  EXPECT_EQ(named, (std::vector<std::string>{"one", "three", "two", "no such session", "one", "done"}));
}

TEST_F(RescoringTest, EndsWhereverItIsCancelled) {
  const std::vector<std::string> names{"one", "three"};
  int calls = 0;
  rescore(names, {}, data(), [&](double, std::string_view) { ++calls; });
  for (const ErrorKind kind : {ErrorKind::cancelled, ErrorKind::io})
    for (int last = 1; last <= calls; ++last) {
      int call = 0;
      try {
        rescore(names, {}, data(), [&](double, std::string_view) {
          if (++call == last) throw Error(kind, "enough");
        });
        ADD_FAILURE() << "went on after call " << last;
      } catch (const Error& e) {
        EXPECT_EQ(e.kind(), kind);
        EXPECT_STREQ(e.what(), "enough");
        EXPECT_EQ(call, last) << "nothing is reported after that";
      }
    }
}

}  // namespace
}  // namespace ream::session
