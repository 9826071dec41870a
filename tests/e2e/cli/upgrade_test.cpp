#include <cstdlib>
#include <filesystem>

#include "e2e/cli/serve_block_fixture.hpp"
#include "support/places.hpp"
#include "support/postgres_server.hpp"

namespace ream::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string password = "correct horse battery";

/// Backups that each version has made, in the order of versions: a case with its plan, a session with a
/// remark, a rubric, a study with somebody in it, an operator and a trainee. Every later version opens them.
/// Each release adds its own, by REAM_NEW_GOLDEN=1 build/cli_upgrade.
struct Golden {
  const char* name;
  bool computes_again;  ///< its sessions have today's physics
};
constexpr Golden goldens[] = {{"0_1_0", true}};

fs::path file_of(const Golden& golden) {
  return source_folder() + "/tests/e2e/golden/data_" + golden.name + ".zip";
}

class Upgrade : public ServeBlock, public testing::WithParamInterface<std::tuple<Golden, const char*>> {
 protected:
  void make(const fs::path& golden) {
    serve_when_ready();
    const std::string id = create();
    request(200, "POST", path_of(id) + "/start");
    until("it has reamed a while", [&] { return duration_s(id) > 2.0; });
    request(200, "POST", path_of(id) + "/stop");
    request(201, "POST", path_of(id) + "/annotations", R"({"words": "Well held", "at_s": 1.5})");
    const std::string study =
        request(201, "POST", "/api/v1/studies", R"({"name": "First year", "cases": ["block"]})").at("id");
    request(201, "POST", "/api/v1/studies/" + study + "/participants",
            R"({"experience": "novice", "name": "Ben", "procedures_done": 3})");
    json rubric = request(200, "GET", "/api/v1/rubrics/standard").at("rubric");
    rubric["name"] = "House";
    rubric["version"] = 1;
    write("data/rubrics/house/1.json", rubric.dump());
    end_server();
    fs::remove_all(folder() / "data/cases/demo");  // the server makes it anew
    run_with_input({"user", "add", "olga"}, password + "\n");
    run_with_input({"user", "add", "tom", "--role", "trainee"}, password + "\n");
    fs::create_directories(golden.parent_path());
    succeed({"backup", golden.string()});
  }

  /// Of the restored folder.
  Words there(Words words) const {
    words.insert(words.end(), where_.begin(), where_.end());
    return words;
  }
  Words where_;
};

TEST_P(Upgrade, EverythingThatAVersionLeftOpens) {
  const auto& [golden, database] = GetParam();
  const fs::path file = file_of(golden);
  if (std::getenv("REAM_NEW_GOLDEN") != nullptr && !fs::exists(file)) make(file);
  where_ = {"--data", "restored"};
  if (std::string(database) == "Postgresql")
    where_.insert(where_.end(), {"--db", PostgresServer::shared().make_database()});
  succeed(there({"restore", file.string()}));

  const json sessions = answer(there({"list", "sessions"}));
  ASSERT_EQ(sessions.size(), 1u);
  const std::string id = sessions.at(0).at("id");
  if (golden.computes_again)
    succeed(there({"replay", id, "--verify"}));
  else
    refuse(1, "physics", there({"replay", id, "--verify"}));
  EXPECT_GT(answer(there({"score", id, "--rubric", "house"})).at("metrics").at("removed_volume_mm3"), 1.0);
  for (const char* made : {"report.pdf", "trace.csv", "bone.stl"})
    succeed(there({"export", id, "--out", made}));
  succeed(there({"render", "block", "--out", "block.png"}));
  succeed(there({"audit", "verify"}));

  const std::string token = answer(there({"user", "token", "olga"})).at("secret");
  const Sent olga{{"Authorization", "Bearer " + token}};
  serve_when_ready(where_);
  for (const char* name : {"olga", "tom"})
    request(200, "POST", "/api/v1/login", json{{"name", name}, {"password", password}}.dump());
  EXPECT_EQ(request(200, "GET", path_of(id), "", olga).at("state"), "stopped");
  const json remarks = request(200, "GET", path_of(id) + "/annotations", "", olga).at("annotations");
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks.at(0).at("words"), "Well held");
  EXPECT_EQ(request(200, "GET", "/api/v1/cases/block/plan", "", olga).at("reamer"), "sphere 12,8");
  EXPECT_EQ(request(200, "GET", "/api/v1/rubrics/house", "", olga).at("rubric").at("name"), "House");
  const json studies = request(200, "GET", "/api/v1/studies", "", olga).at("studies");
  ASSERT_EQ(studies.size(), 1u);
  const std::string people = "/api/v1/studies/" + studies.at(0).at("id").get<std::string>() + "/participants";
  EXPECT_EQ(request(200, "GET", people, "", olga).at("participants").at(0).at("procedures_done"), 3);
  request(201, "POST", path_of(id) + "/replay", "", olga);
  request(201, "POST", "/api/v1/sessions", R"({"case": "block", "script": "press"})", olga);
  end_server();
}

INSTANTIATE_TEST_SUITE_P(From, Upgrade,
                         testing::Combine(testing::ValuesIn(goldens),
                                          testing::Values("Sqlite", "Postgresql")),
                         [](const testing::TestParamInfo<Upgrade::ParamType>& one) {
                           return std::string(std::get<0>(one.param).name) + "_" + std::get<1>(one.param);
                         });

}  // namespace
}  // namespace ream::test
