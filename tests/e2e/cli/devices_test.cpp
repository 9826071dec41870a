#include <signal.h>

#include <thread>

#include "e2e/cli/command_line.hpp"

namespace ream::test {
namespace {

using nlohmann::json;

class Devices : public CommandLine {};

TEST_F(Devices, AreListedWithWhatTheyCan) {
  const json rows = answer({"devices", "--json"});
  ASSERT_GE(rows.size(), 3u);
  std::vector<std::string> names;
  for (const json& row : rows) {
    names.push_back(row.at("name"));
    EXPECT_TRUE(row.at("usable").is_boolean());
    EXPECT_EQ(row.at("usable").get<bool>(), row.at("reason").get<std::string>().empty());
    EXPECT_GT(row.at("force_max_n").get<double>(), 0.0);
    EXPECT_GE(row.at("dof").get<int>(), 3);
  }
  EXPECT_EQ(names.front(), "script");
  for (const char* name : {"network", "browser"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
  EXPECT_NE(succeed({"devices"}).out.find("script"), std::string::npos);
}

TEST_F(Devices, TheScriptedHandFeelsTheWallAndIsUsable) {
  const json trial = answer({"devices", "--test", "script", "--profile", "touch", "--json"});
  EXPECT_TRUE(trial.at("usable").get<bool>());
  EXPECT_EQ(trial.at("verdict").front(), "usable");
  EXPECT_EQ(trial.at("ticks"), 5500);
  EXPECT_GT(trial.at("wall_s").get<double>(), 0.5);
  EXPECT_GT(trial.at("force_max_n").get<double>(), 0.1);
  EXPECT_LE(trial.at("force_max_n").get<double>(), 0.33 + 1e-9) << "a tenth of the touch's";
  EXPECT_GT(trial.at("moved_mm").at(2).get<double>(), 10.0);
}

TEST_F(Devices, InterruptedInATrialTheyEndQuicklyAndInWords) {
  const auto program = start({"devices", "--test", "network"}, "trial");
  for (int i = 0; i < 6000 && printed("trial.err").find("ws://127.0.0.1:") == std::string::npos; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  program->send_signal(SIGINT);
  EXPECT_EQ(program->wait(std::chrono::seconds(30)), 1);
  EXPECT_NE(printed("trial.err").find("interrupted"), std::string::npos) << printed("trial.err");
}

TEST_F(Devices, ASetUpIsToldInWordsAndKept) {
  const json told =
      answer({"devices", "--setup", "network", "--axes", "-y,z,-x", "--hand", "left", "--json"});
  json kept = json_of("data/devices/network.json");
  EXPECT_EQ(kept, told.at("setup"));
  EXPECT_EQ(kept.at("axes").at("right"), json({0.0, -1.0, 0.0}));
  EXPECT_EQ(kept.at("hand"), "left");
  EXPECT_EQ(kept.at("scale"), 1.0);
  succeed({"devices", "--setup", "network", "--scale", "2.5"});
  kept["scale"] = 2.5;
  EXPECT_EQ(json_of("data/devices/network.json"), kept) << "the rest stays";
}

TEST_F(Devices, WhatCannotBeIsRefusedInALine) {
  refuse(1, "no device 'nonsense'", {"devices", "--test", "nonsense"});
  refuse(1, "no device '../x'", {"devices", "--setup", "../x", "--scale", "2"});
  refuse(1, "page of a session", {"devices", "--test", "browser"});
  refuse(1, "no set-up", {"devices", "--setup", "script", "--scale", "2"});
  refuse(1, "x,y,z", {"devices", "--setup", "network", "--axes", "x,y,-z"});
  refuse(2, "--scale", {"devices", "--setup", "network", "--scale", "0"});
  refuse(2, "--hand", {"devices", "--setup", "network", "--hand", "both"});
  refuse(2, "terminal", {"devices", "--setup", "network"});
  refuse(2, "--setup", {"devices", "--axes", "x,y,z"});
  refuse(2, "--test", {"devices", "--test", "script", "--setup", "network"});
}

}  // namespace
}  // namespace ream::test
