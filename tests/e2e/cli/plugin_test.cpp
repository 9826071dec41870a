// Plug-ins as people use them: tried, simulated with, verified with, and on a server.
#include "core/error.hpp"
#include "e2e/cli/serve_block_fixture.hpp"
#include "support/places.hpp"

namespace ream::test {
namespace {

using nlohmann::json;

std::string built_plugin(const std::string& name) {
  return build_folder() + "/tests/support/plugins/" + name + ".so";
}

class PlugIn : public ServeBlock {
 protected:
  void SetUp() override {
    ServeBlock::SetUp();
    write("press.json", R"({"device": "hand", "duration_s": 1.5, "vibration": {"source": "off"},
        "hand": {"start_mm": [0, 0, -0.3], "force_profile": [{"t_s": 0, "force_n": 40}]}})");
  }
  Words simulate(const std::string& out, const std::string& plugin = {}) {
    Words words{"simulate", "--case", "data/cases/block", "--script", "press.json",
                "--out",    out,      "--backend",        "cpu"};
    if (!plugin.empty()) words.insert(words.end(), {"--plugin", built_plugin(plugin)});
    return words;
  }
};

TEST_F(PlugIn, TheTemplateOfAFeedModelGivesTheSessionOfTheBuiltInOne) {
  const json tried = answer({"plugin", built_plugin("feed_model"), "--json"});
  EXPECT_EQ(tried.at("name"), "edge-law");
  succeed(simulate("built-in"));
  succeed(simulate("own", "feed_model"));
  const json metrics = json_of("own/metrics.json");
  EXPECT_GT(metrics.at("removed_volume_mm3").get<double>(), 0.0);
  EXPECT_EQ(metrics.at("session_hash"), json_of("built-in/metrics.json").at("session_hash"));
  const json session = json_of("own/session.json");
  EXPECT_EQ(session.at("model"), "edge-law 1.0");
  EXPECT_EQ(session.at("plugin").at("sha256"), tried.at("sha256"));
  EXPECT_FALSE(json_of("built-in/session.json").contains("plugin"));

  const Words verify{"replay", "own", "--verify", "--case", "data/cases/block"};
  refuse(exit_code(ErrorKind::conflict), "was made with plug-in edge-law 1.0 (sha256 ", verify);
  Words other = verify, same = verify;
  other.insert(other.end(), {"--plugin", built_plugin("faulty_nothing")});
  refuse(exit_code(ErrorKind::conflict), "the one that was given is plug-in faulty 0.1", other);
  same.insert(same.end(), {"--plugin", built_plugin("feed_model"), "--json"});
  EXPECT_EQ(answer(same).at("verified"), true);
  refuse(exit_code(ErrorKind::usage), "both give a feed model", [&] {
    Words words = simulate("twice", "feed_model");
    words.insert(words.end(), {"--model", "thesis"});
    return words;
  }());
}

TEST_F(PlugIn, AScoreStandsBesideTheRubricsAndIsNotLostByAnother) {
  succeed(simulate("judged", "score"));
  const json score = json_of("judged/score.json");
  EXPECT_EQ(score.at("plugin_score").at("plugin").at("name"), "depth-alone");
  EXPECT_TRUE(score.at("score").at("points").is_number() || score.at("score").at("points").is_null());
  refuse(exit_code(ErrorKind::conflict), "its score was made with plug-in depth-alone 1.0",
         {"score", "judged", "--case", "data/cases/block", "--save"});
  const Outcome again =
      succeed({"score", "--plugin", built_plugin("score"), "judged", "--case", "data/cases/block", "--save"});
  EXPECT_NE(again.out.find("by depth-alone 1.0"), std::string::npos) << again.out;
  EXPECT_EQ(json_of("judged/score.json").at("plugin_score"), score.at("plugin_score"));
}

TEST_F(PlugIn, ThatIsNotFitForATickStartsNothing) {
  for (const auto& [name, words] : {std::pair{"allocates", "allocates memory (malloc) in a tick"},
                                    {"crashes", "crashes: Segmentation fault"}}) {
    const std::string file = built_plugin(std::string("faulty_") + name);
    refuse(exit_code(ErrorKind::invalid_input), words, {"plugin", file});
    refuse(exit_code(ErrorKind::invalid_input), words, simulate("none", std::string("faulty_") + name));
    refuse(exit_code(ErrorKind::usage), words, {"serve", "--port", "0", "--plugin", file});
  }
  refuse(exit_code(ErrorKind::usage), "no device 'steady-hand'",
         {"serve", "--port", "0", "--device", "steady-hand"});
}

TEST_F(PlugIn, AServerTakesThemFromItsSettings) {
  write("ream.toml", "[serve]\nplugin = [\"" + built_plugin("device") + "\", \"" +
                         built_plugin("feed_model") + "\"]\ndevice = \"steady-hand\"\n");
  environment_["REAM_CONFIG"] = (folder() / "ream.toml").string();
  serve_when_ready();
  const std::string id = request(201, "POST", "/api/v1/sessions", R"({"case": "block"})").at("id");
  request(200, "POST", path_of(id) + "/start");
  until("the handle has reamed", [&] {
    const json metrics = request(200, "GET", path_of(id) + "/metrics");
    return metrics.at("removed_volume_mm3").is_number() && metrics.at("removed_volume_mm3") > 0.0;
  });
  request(200, "POST", path_of(id) + "/stop");
  const json session = request(200, "GET", path_of(id));
  EXPECT_EQ(session.at("device").at("name"), "steady-hand");
  end_server();
  EXPECT_EQ(json_of("data/sessions/" + id + "/session.json").at("plugin").at("name"), "edge-law");
  EXPECT_NE(printed("server.err").find("plug-in steady-hand 1.0"), std::string::npos);
}

TEST_F(PlugIn, ADeviceIsListedWithTheOthers) {
  for (const json& row : answer({"devices", "--plugin", built_plugin("device"), "--json"}))
    if (row.at("name") == "steady-hand") {
      EXPECT_TRUE(row.at("usable").get<bool>());
      EXPECT_EQ(row.at("force_max_n"), 3.3);
      return;
    }
  FAIL() << "it is not listed";
}

}  // namespace
}  // namespace ream::test
