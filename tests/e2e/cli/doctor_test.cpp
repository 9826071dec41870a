#include "e2e/cli/serve_fixture.hpp"

namespace ream::test {
namespace {

using nlohmann::json;

class Doctor : public Serve {
 protected:
  /// Its findings by their subject.
  std::map<std::string, json> findings(int exit_code, Words arguments) {
    arguments.insert(arguments.begin(), {"doctor", "--json"});
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.error;
    std::map<std::string, json> by_subject;
    const json all = json::parse(outcome.out);
    for (const json& finding : all.at("findings")) by_subject[finding.at("subject")] = finding;
    return by_subject;
  }
};

TEST_F(Doctor, FindsNothingWrongWithAFreshFolderAndMakesNothing) {
  const auto before = tree();
  const auto found = findings(0, {"--data", "fresh"});
  EXPECT_EQ(tree(), before);
  for (const char* subject : {"page", "reader", "pictures", "data folder", "disk", "database", "address",
                              "OpenCL", "processor", "real time", "clock"})
    EXPECT_TRUE(found.contains(subject)) << subject;
  for (const auto& [subject, finding] : found) {
    EXPECT_NE(finding.at("state"), "fault") << finding;
    EXPECT_EQ(finding.at("remedy") == "", finding.at("state") == "good") << finding;
  }
}

TEST_F(Doctor, SeesAServerAndWhatWouldBeInItsWay) {
  serve();
  until("it is ready", [&] { return http_request(port_, "GET", "/readyz").status == 200; });
  const auto running = findings(0, {});
  EXPECT_NE(running.at("data folder").at("text").get<std::string>().find("A server runs"), std::string::npos);
  const std::string port = std::to_string(port_);
  const std::string settings = write("ream.toml", "[serve]\nport = " + port + "\n");
  const auto second = findings(1, {"--config", settings, "--data", "other"});
  EXPECT_EQ(second.at("address").at("state"), "fault");
  EXPECT_NE(second.at("address").at("text").get<std::string>().find(port), std::string::npos);
}

TEST_F(Doctor, NamesWhatKeepsAServerFromStarting) {
  write("file", "");
  EXPECT_EQ(findings(1, {"--data", "file/data"}).at("data folder").at("state"), "fault");
  const std::string settings = write("ream.toml", "[serve]\nhost = '0.0.0.0'\n");
  const auto open = findings(1, {"--config", settings});
  EXPECT_NE(open.at("address").at("text").get<std::string>().find("user add"), std::string::npos);
  EXPECT_EQ(findings(1, {"--db", "postgresql://nobody@127.0.0.1:1/none"}).at("database").at("state"),
            "fault");
}

TEST_F(Doctor, SaysInLinesWhatItSaysAsJson) {
  const Outcome outcome = succeed({"doctor", "--data", "fresh"});
  EXPECT_NE(outcome.out.find("good\t"), std::string::npos) << outcome.out;
}

TEST_F(CommandLine, CommandsAndOptionsAreCompletedByBash) {
  write("complete.sh", succeed({"completion", "bash"}).out + R"(
complete_words() { COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); COMPREPLY=(); _ream; echo "${COMPREPLY[*]}"; }
complete_words ream ser
complete_words ream --data x user a
complete_words ream user add --ro
complete_words ream simulate --ca
)");
  const auto bash = start_program({"/bin/bash", "complete.sh"}, "bash");
  EXPECT_EQ(bash->wait(std::chrono::seconds(20)), 0);
  EXPECT_EQ(printed("bash.out"), "serve\nadd\n--role\n--case\n") << printed("bash.err");
}

}  // namespace
}  // namespace ream::test
