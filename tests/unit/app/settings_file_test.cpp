#include "app/cli/commands.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <CLI/CLI.hpp>

#include "app/cli/serve_options.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::app {
namespace {

/// The command line as `ream` has it, as far as settings files are concerned.
class SettingsFile : public testing::Test {
 protected:
  SettingsFile() {
    for (const char* name : {"REAM_CONFIG", "REAM_DATA", "REAM_DB"}) ::unsetenv(name);
    app_.add_option("--data", data_);
    app_.add_option("--db", db_);
    app_.fallthrough();
    app_.require_subcommand(1);
    add_serve_options(*app_.add_subcommand("serve"), options_);
    app_.add_subcommand("list");
    add_settings_file(app_);
  }
  ~SettingsFile() override {
    for (const char* name : {"REAM_DATA", "REAM_DB"}) ::unsetenv(name);
  }

  void parse(const std::string& text, std::vector<std::string> more = {}) {
    file_ = folder_.write("ream.toml", text);
    more.insert(more.end(), {file_.string(), "--config", "serve"});
    app_.parse(more);  // CLI11 takes them from the back
  }
  void refuse(const std::string& mentioned, const std::string& text) {
    test::expect_error(ErrorKind::usage, mentioned, [&] { parse(text); });
  }

  test::TemporaryFolder folder_;
  std::filesystem::path file_, data_;
  std::string db_;
  ServeOptions options_;
  CLI::App app_;
};

TEST_F(SettingsFile, SetsWhatTheCommandLineDoesNot) {
  parse(R"(data = "/srv/ream"   # where cases and sessions lie
[serve]
port = 9001
host = "::1"
public-name = ["ream.example.org", "10.0.0.7"]
trusted-proxy = []
insecure = true
keep-sessions-days = 365
log-format = 'json'
)",
        {"9002", "--port"});
  EXPECT_EQ(data_, "/srv/ream");
  EXPECT_EQ(options_.address.port, 9002);
  EXPECT_EQ(options_.address.host, "::1");
  EXPECT_EQ(options_.address.public_names, (std::vector<std::string>{"ream.example.org", "10.0.0.7"}));
  EXPECT_TRUE(options_.address.trusted_proxies.empty());
  EXPECT_TRUE(options_.address.insecure);
  EXPECT_EQ(options_.keep_sessions_days, 365);
  EXPECT_EQ(options_.log_format, "json");
  EXPECT_EQ(options_.realtime, "try");
}

TEST_F(SettingsFile, ComesAfterTheEnvironment) {
  ::setenv("REAM_DATA", "/from/environment", 1);
  ::setenv("REAM_DB", "sqlite:/from/environment.db", 1);
  parse("data = '/from/file'\ndb = 'sqlite:/from/file.db'\n");
  EXPECT_EQ(data_, "");
  EXPECT_EQ(db_, "");
}

TEST_F(SettingsFile, CountsForOtherCommandsToo) {
  file_ = folder_.write("ream.toml", "data = '/srv/ream'\n[serve]\nport = 9001\n");
  app_.parse(std::vector<std::string>{file_.string(), "--config", "list"});
  EXPECT_EQ(data_, "/srv/ream");
}

TEST_F(SettingsFile, RefusesWhatNothingTakesWithItsLine) {
  refuse("ream.toml, line 1: no setting 'prot'", "prot = 1\n");
  refuse("ream.toml, line 3: no setting 'prot' in [serve]", "\n[serve]\nprot = 1\n");
  refuse("line 1: no section [server]", "[server]\nport = 1\n");
  refuse("line 2: no section [serve2]", "[serve]\n[serve2]\n");
  refuse("no setting 'help'", "help = true\n");
  refuse("no setting 'config'", "config = 'other.toml'\n");
  refuse("no setting 'serve'", "serve = 1\n");
  refuse("'host' is a text", "[serve]\nhost = 1.5\n");
  refuse("'host' is a text", "[serve]\nhost = ['a', 'b']\n");
  refuse("'public-name' is a text", "[serve]\npublic-name = [['a'], ['b']]\n");
  refuse("'port' is a text", "[serve]\nport = 2026-01-31\n");
  for (const char* not_toml :
       {"port\n", "[serve\nport = 1\n", "[serve]\nhost = localhost\n", "a = 1\na = 2\n",
        "[serve]\nport = 1\n[serve]\nport = 2\n", "a = \"\n", "\x01", "= 1\n"})
    refuse("not TOML", not_toml);
}

TEST_F(SettingsFile, HoldsValuesToTheRulesOfTheOptions) {
  EXPECT_THROW(parse("[serve]\nport = 99999\n"), CLI::ConversionError);
}
TEST_F(SettingsFile, HoldsDaysToTheirRange) {
  EXPECT_THROW(parse("[serve]\nkeep-deleted-days = -1\n"), CLI::ValidationError);
}
TEST_F(SettingsFile, HoldsWordsToTheOnesThatAreKnown) {
  EXPECT_THROW(parse("[serve]\nrealtime = 'always'\n"), CLI::ValidationError);
}
TEST_F(SettingsFile, OfSeveralTheLastIsRead) {
  const std::string first = folder_.write("first.toml", "data = '/first'\n");
  parse("data = '/last'\n", {first, "--config"});
  EXPECT_EQ(data_, "/first") << "CLI11 takes the words from the back, so that this one came last";
}
TEST_F(SettingsFile, MustBeThere) {
  EXPECT_THROW(app_.parse(std::vector<std::string>{"/nowhere.toml", "--config", "serve"}), CLI::FileError);
}

}  // namespace
}  // namespace ream::app
