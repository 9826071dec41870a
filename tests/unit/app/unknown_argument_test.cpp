#include "app/cli/commands.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

namespace ream::app {
namespace {

class UnknownArgument : public testing::Test {
 protected:
  UnknownArgument() {
    app_.add_flag("--json");
    CLI::App* simulate = app_.add_subcommand("simulate");
    simulate->add_option("--case", case_)->required();
    simulate->add_option("--out", out_);
    CLI::App* user = app_.add_subcommand("user");
    user->add_subcommand("add")->add_option("name", out_);
    user->add_subcommand("remove");
  }
  std::string about(const std::vector<std::string>& arguments) { return unknown_argument(app_, arguments); }

  std::string case_, out_;
  CLI::App app_;
};

TEST_F(UnknownArgument, IsNamedWithTheNearestThatIsThere) {
  EXPECT_EQ(about({"simulate", "--cse", "demo"}),
            "no option '--cse' of ream simulate; did you mean '--case'?");
  EXPECT_EQ(about({"simulate", "--csae=demo"}),
            "no option '--csae' of ream simulate; did you mean '--case'?");
  EXPECT_EQ(about({"simulate", "--jsno"}), "no option '--jsno' of ream simulate; did you mean '--json'?");
  EXPECT_EQ(about({"simualte"}), "no command 'ream simualte'; did you mean 'simulate'?");
  EXPECT_EQ(about({"--json", "user", "ad"}), "no command 'ream user ad'; did you mean 'add'?");
}

TEST_F(UnknownArgument, HasNoSuggestionWhereNothingIsNear) {
  EXPECT_EQ(about({"simulate", "--frobnicate"}), "no option '--frobnicate' of ream simulate");
  EXPECT_EQ(about({"q"}), "no command 'ream q'");
}

TEST_F(UnknownArgument, IsNoValue) {
  EXPECT_EQ(about({"simulate", "--case", "--cse", "--out", "-1.5"}), "");
  EXPECT_EQ(about({"simulate", "--case=x", "-3"}), "");
  EXPECT_EQ(about({"user", "add", "anna"}), "");
  EXPECT_EQ(about({"simulate", "--", "--anything"}), "");
  EXPECT_EQ(about({}), "");
  EXPECT_EQ(about({"--json"}), "");
}

}  // namespace
}  // namespace ream::app
