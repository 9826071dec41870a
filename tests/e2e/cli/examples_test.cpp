// What lies in examples/ can be used as its README says.
#include "core/file.hpp"
#include "e2e/cli/command_line.hpp"
#include "support/json_schema.hpp"
#include "support/places.hpp"

namespace ream::test {
namespace {

namespace fs = std::filesystem;

class Examples : public CommandLine {
 protected:
  const fs::path examples_ = fs::path(source_folder()) / "examples";
  const std::string readme_ = read_text_file(examples_ / "README.md");
};

TEST_F(Examples, EveryScriptReamsTheDemo) {
  take_demo_case();
  size_t scripts = 0;
  for (const auto& entry : fs::directory_iterator(examples_ / "scripts")) {
    SCOPED_TRACE(entry.path().string());
    const std::string name = entry.path().stem();
    const auto metrics =
        answer({"simulate", "--case", "demo", "--script", entry.path(), "--backend", "cpu", "--out", name});
    EXPECT_GT(metrics.at("removed_volume_mm3").get<double>(), 5.0);
    EXPECT_NE(readme_.find("scripts/" + name + ".json"), std::string::npos) << "README says what it shows";
    ++scripts;
  }
  EXPECT_GE(scripts, 5u);
  const Outcome scored = succeed({"score", "robot", "--rubric", examples_ / "rubric.json"});
  EXPECT_NE(scored.out.find("of 100"), std::string::npos) << scored.out;
}

TEST_F(Examples, TheQuestionnaireFollowsItsSchema) {
  const auto schema = read_json_file(fs::path(source_folder()) / "proto/questionnaire.schema.json");
  for (const std::string& fault : schema_faults(schema, read_json_file(examples_ / "questionnaire.json")))
    ADD_FAILURE() << fault;
}

}  // namespace
}  // namespace ream::test
