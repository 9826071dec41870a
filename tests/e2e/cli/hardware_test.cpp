// Haptic devices as people use them: listed, tried out, in a server that is told to end, crashes, or is
// killed. The fakes' diaries say when which force was on the hand and in which order the hardware was let go.
#include <signal.h>

#include <cmath>
#include <sstream>

#include "core/file.hpp"
#include "device/device_setup.hpp"
#include "e2e/cli/serve_block_fixture.hpp"
#include "support/fake_haply.hpp"
#include "support/places.hpp"

namespace ream::test {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

std::string fake_library(const std::string& name) {
  return build_folder() + "/tests/support/libfake_" + name + ".so";
}

/// A line of a fake's diary that outlived its process.
struct Entry {
  int64_t t_ns = 0;
  std::string what;
  double force_n = 0.0;  ///< of "force"
};

class Hardware : public ServeBlock {
 protected:
  void SetUp() override {
    ServeBlock::SetUp();
    environment_["FAKE_HARDWARE_LOG"] = (printed_.path() / "diary").string();
    environment_["REAM_DHD_LIBRARY"] = fake_library("dhd");
    environment_["REAM_HD_LIBRARY"] = fake_library("hd");
  }
  void set_up_haply(const FakeHaply& fake, uint16_t port) {
    json setup = device::to_json(device::default_device_setup("haply"));
    setup["connection"] = {{"port", port}, {"events_port", fake.events_port()}};
    write("data/devices/haply.json", setup.dump());
  }
  std::vector<Entry> diary() const {
    std::istringstream lines(std::filesystem::exists(printed_.path() / "diary") ? printed("diary") : "");
    std::vector<Entry> entries;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      Entry entry;
      std::string kind;
      words >> entry.t_ns >> kind;
      if (kind == "force") words >> entry.force_n;
      std::string rest;
      std::getline(words, rest);
      entry.what = kind + rest;
      entries.push_back(entry);
    }
    return entries;
  }
  /// A session that pushes with the device.
  void run_session(const std::string& device, const std::string& backend = "cpu") {
    serve({"--backend", backend, "--realtime", "off", "--device", device});
    until_ready();
    const std::string id =
        request(201, "POST", "/api/v1/sessions", json{{"case", "block"}, {"device", device}}.dump()).at("id");
    request(200, "POST", path_of(id) + "/start");
  }
  /// The calls after the last force that pushed.
  static std::vector<std::string> after_the_last_push(const std::vector<Entry>& entries) {
    std::vector<std::string> calls;
    for (const Entry& entry : entries) {
      if (entry.force_n > 0.0) calls.clear();
      if (entry.what.starts_with("call")) calls.push_back(entry.what.substr(5));
    }
    return calls;
  }
  bool pushes() const {
    const std::vector<Entry> entries = diary();
    return !entries.empty() && entries.back().force_n > 0.3;
  }
  void push_away(const std::string& direction) { environment_["FAKE_HARDWARE_PUSH"] = "3," + direction; }
};

TEST_F(Hardware, IsListedWithWhatIsMissingAndWhatToDo) {
  environment_["REAM_DHD_LIBRARY"] = "/nowhere/libdhd.so";
  environment_.erase("REAM_HD_LIBRARY");
  FakeHaply fake;
  fake.die();
  set_up_haply(fake, fake.port());
  std::map<std::string, json> rows;
  for (const json& row : answer({"devices", "--json"})) rows[row.at("name")] = row;
  for (const auto& [name, words] : {std::pair{"haply", "start Haply's Inverse Service"},
                                    {"forcedimension", "/nowhere/libdhd.so"},
                                    {"openhaptics", "REAM_HD_LIBRARY"}}) {
    ASSERT_TRUE(rows.contains(name)) << name;
    EXPECT_FALSE(rows[name].at("usable").get<bool>()) << name;
    EXPECT_NE(rows[name].at("reason").get<std::string>().find(words), std::string::npos) << rows[name];
    refuse(1, words, {"devices", "--test", name});
  }
  fake.revive();
  environment_["REAM_DHD_LIBRARY"] = fake_library("dhd");
  environment_["REAM_HD_LIBRARY"] = fake_library("hd");
  for (const json& row : answer({"devices", "--json"})) EXPECT_TRUE(row.at("usable").get<bool>()) << row;
}

TEST_F(Hardware, ATrialOfHaplyFeelsTheWall) {
  FakeHaply fake;
  set_up_haply(fake, fake.port());
  FakeHand hand;
  hand.axis = {0, 0, -1};  // Haply's z is up, and the trial's wall below
  fake.hardware().set_hand(hand);
  fake.hardware().push_n = 0.4;
  Outcome outcome;
  for (int attempt = 0; attempt < 6; ++attempt) {
    outcome = run({"devices", "--test", "haply", "--json"});
    const json trial = json::parse(outcome.out);
    EXPECT_LE(fake.hardware().largest_force_n(), 0.5 + 1e-6) << "a tenth of what it can";
    EXPECT_EQ(trial.at("wild_poses"), 0);
    if (outcome.exit_code != 0) continue;  // too much to do here for ages of 10 ms
    EXPECT_TRUE(trial.at("usable").get<bool>());
    EXPECT_GT(trial.at("wall_s").get<double>(), 0.5);
    EXPECT_GT(trial.at("pose_rate_hz").get<double>(), 200.0);
    EXPECT_EQ(fake.hardware().force_now_n(), 0.0);
    EXPECT_TRUE(fake.hardware().refusals().empty());
    return;
  }
  FAIL() << "in none of 6 trials: " << outcome.out << outcome.error;
}

TEST_F(Hardware, IsLetGoInOrderWhenTheServerIsToldToEnd) {
  const std::vector<std::string> force_dimension{"dhdEnableForce off", "dhdClose"},
      open_haptics{"hdDisable HD_FORCE_OUTPUT", "hdStopScheduler", "hdUnschedule", "hdDisableDevice"};
  for (const auto& [name, direction, order, signal, backend] :
       {std::tuple{"forcedimension", "-1,0,0", force_dimension, SIGTERM, "cpu"},
        {"openhaptics", "0,0,-1", open_haptics, SIGQUIT, "cpu"},
        {"forcedimension", "-1,0,0", force_dimension, SIGHUP, "opencl"}}) {
    std::filesystem::remove(printed_.path() / "diary");
    push_away(direction);
    run_session(name, backend);
    until("a force is on the hand", [&] { return pushes(); });
    server_->send_signal(signal);
    EXPECT_EQ(server_->wait(20s), 0) << printed("server.err");
    const std::vector<Entry> entries = diary();
    EXPECT_EQ(after_the_last_push(entries), order) << name;
    const std::string first_call = "call " + order.front();
    const auto zero = std::find_if(entries.rbegin(), entries.rend(),
                                   [&](const Entry& entry) { return entry.what == first_call; });
    ASSERT_NE(zero, entries.rend());
    EXPECT_TRUE((zero + 1)->what.starts_with("force") && (zero + 1)->force_n == 0.0)
        << name << ": zero force first, then off";
  }
}

TEST_F(Hardware, IsLeftWithoutForceByAServerThatCrashes) {
  for (const auto& [name, direction, signal, backend] :
       {std::tuple{"forcedimension", "-1,0,0", SIGSEGV, "cpu"},
        {"openhaptics", "0,0,-1", SIGSEGV, "cpu"},
        {"forcedimension", "-1,0,0", SIGABRT,
         "opencl"}}) {  // PoCL's compiler has a handler of its own for it
    std::filesystem::remove(printed_.path() / "diary");
    push_away(direction);
    run_session(name, backend);
    until("a force is on the hand", [&] { return pushes(); });
    server_->send_signal(signal);
    EXPECT_EQ(server_->wait(20s), 128 + signal);
    const std::vector<Entry> entries = diary();
    EXPECT_EQ(entries.back().force_n, 0.0) << name << ": " << entries.back().what;
  }
}

/// Nothing of the program runs any more: what the hardware does by itself must have been arranged beforehand.
TEST_F(Hardware, HasBeenToldToLetGoByItselfOfAServerThatIsKilled) {
  push_away("-1,0,0");
  run_session("forcedimension");
  until("a force is on the hand", [&] { return pushes(); });
  server_->send_signal(SIGKILL);
  EXPECT_EQ(server_->wait(20s), 128 + SIGKILL);
  const std::vector<Entry> entries = diary();
  const auto at = [&](const std::string& what) {
    return std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.what == what; });
  };
  EXPECT_LT(at("call dhdSetWatchdog 240"), at("call dhdEnableForce on"));
  EXPECT_NE(at("call dhdEnableForce on"), entries.end());
}

TEST_F(Hardware, HaplysServiceForgetsTheForceOfAServerThatEnds) {
  for (const int signal : {SIGKILL, SIGSEGV, SIGTERM}) {
    FakeHaply fake;
    set_up_haply(fake, fake.port());
    FakeHand hand;
    hand.axis = {0, 1, 0};
    fake.hardware().set_hand(hand);
    fake.hardware().push_n = 3.0;
    run_session("haply");
    until("a force is on the hand", [&] { return fake.hardware().force_now_n() > 0.3; });
    const int64_t since_ns = monotonic_ns();
    server_->send_signal(signal);
    server_->wait(20s);
    std::this_thread::sleep_for(20ms);
    EXPECT_EQ(fake.hardware().force_now_n(), 0.0);
    std::cout << "signal " << signal << ": no force after " << fake.hardware().ms_until_no_force(since_ns)
              << " ms\n";
    EXPECT_TRUE(fake.hardware().refusals().empty()) << fake.hardware().refusals().front();
    if (signal == SIGKILL) continue;
    EXPECT_EQ(fake.hardware().samples().back().force_n, 0.0) << "the last it was told";
  }
}

}  // namespace
}  // namespace ream::test
