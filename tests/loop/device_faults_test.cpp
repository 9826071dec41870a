// Every driver that connects over the network, every fault: the force goes to nothing within its time, the
// session says what happened, and bone and recording stay whole. Times are counted in ticks of the recording
// and in answers, and the loop's guard has a clock that stands still, so a slow machine, which adds faults of
// its own, cannot fail it. The table for people is in proto/device.md.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/hash.hpp"
#include "record/recording.hpp"
#include "record/tick_report.hpp"
#include "support/fake_device_client.hpp"
#include "support/live_server.hpp"

namespace ream::test {
namespace {

using namespace std::chrono_literals;

/// Once a pose is too old the force falls to nothing within this many ticks.
constexpr int fading_ticks = 20;
/// What the reamer's shaking may add from one tick to the next, N.
constexpr double shaking_n = 1.0;

/// A person who presses the tool against the slab: with a handle that goes there, or with wishes.
class Presser {
 public:
  Presser(const LiveServer& server, const std::string& id, bool steers)
      : server_(server), id_(id), steers_(steers) {
    connect();
  }
  void connect() { client_ = std::make_unique<FakeDeviceClient>(server_.port(), id_); }
  FakeDeviceClient& client() { return *client_; }

  /// One message, about a millisecond after the last. While the session rests no answer has a force.
  Felt press() {
    std::this_thread::sleep_for(1ms);
    const Felt felt = say();
    if (felt.link == wire::LinkState::lost) {
      EXPECT_EQ(felt.force(), 0.0);
    }
    return felt;
  }
  std::string bytes_of(uint32_t sequence) const {
    HandleWords handle;
    handle.sequence = sequence;
    handle.place_mm = {0, 0, -way_mm_};
    SteeringWords command;
    command.sequence = sequence;
    return steers_ ? steering_bytes(command) : handle_bytes(handle);
  }
  std::string no_number() const {
    HandleWords handle;
    handle.place_mm = {std::nan(""), 0, 0};
    SteeringWords command;
    command.push_n = std::numeric_limits<float>::quiet_NaN();
    return steers_ ? steering_bytes(command) : handle_bytes(handle);
  }

 private:
  Felt say() {
    if (steers_) {
      SteeringWords command;
      command.push_n = 40.0f;
      return client_->say(command);
    }
    // Away from the person is into the bone: on until something holds it, as a hand would.
    if (client_->felt().force() < 20.0) way_mm_ += 0.1;
    HandleWords handle;
    handle.place_mm = {0, 0, -way_mm_};
    return client_->say(handle);
  }

  const LiveServer& server_;
  const std::string id_;
  const bool steers_;
  double way_mm_ = 0.0;
  std::unique_ptr<FakeDeviceClient> client_;
};

struct Fault {
  const char* name;
  bool lost;  ///< whether it always lasts long enough for the session to rest
  std::function<void(Presser&)> happen;
  std::function<void(const nlohmann::json& device)> told = [](const nlohmann::json&) {};
};

void wait_for(std::chrono::milliseconds time) { std::this_thread::sleep_for(time); }

const std::vector<Fault>& faults() {
  static const std::vector<Fault> all{
      {"drop", true, [](Presser& p) { p.client().vanish(), wait_for(500ms), p.connect(); }},
      {"reconnect", true, [](Presser& p) { p.connect(); }},
      {"garbage", true,
       [](Presser& p) {
         for (int i = 0; i < 25; ++i) p.client().send_raw("no message");
         const auto [code, words] = p.client().closing();
         EXPECT_EQ(code, 4002);
         EXPECT_NE(words.find("of no use"), std::string::npos) << words;
         wait_for(500ms);
         p.connect();
       },
       [](const nlohmann::json& device) { EXPECT_GE(device.at("refused"), 20); }},
      {"stall 5 ms", false, [](Presser&) { wait_for(5ms); }},
      {"stall 10 ms", false, [](Presser&) { wait_for(10ms); }},
      {"stall 50 ms", false, [](Presser&) { wait_for(50ms); }},
      {"stall 500 ms", true, [](Presser&) { wait_for(500ms); }},
      {"late", false,
       [](Presser& p) {
         for (uint32_t i = 1; i <= 5; ++i) {
           p.client().send_raw(p.bytes_of(p.client().sequence() - i));
           p.client().receive();
         }
       },
       [](const nlohmann::json& device) { EXPECT_EQ(device.at("late"), 5); }},
      {"reordered", false,
       [](Presser& p) {
         const uint32_t now = p.client().sequence();
         for (const uint32_t ahead : {2u, 1u, 4u, 3u}) {
           p.client().send_raw(p.bytes_of(now + ahead));
           p.client().receive();
         }
         p.client().set_sequence(now + 5);
       },
       [](const nlohmann::json& device) {
         EXPECT_EQ(device.at("late"), 2);
         EXPECT_EQ(device.at("missing"), 2);
       }},
      {"NaN", false, [](Presser& p) { p.client().send_raw(p.no_number()); },
       [](const nlohmann::json& device) { EXPECT_EQ(device.at("refused"), 1); }},
      {"vanished while pushing", true, [](Presser& p) { wait_for(1000ms), p.connect(); }},
  };
  return all;
}

double force_n(const record::ops::Tick& tick) {
  return std::hypot(tick.hand_force_x_n, tick.hand_force_y_n, tick.hand_force_z_n);
}

class DeviceFault : public testing::TestWithParam<std::tuple<const char*, size_t>> {
 protected:
  /// In every tick of the recording.
  void expect_no_force_without_a_hand(const record::Recording& recording) {
    int stale = 0, rests = 0, breaks = 0;
    double at_break_n = 0.0, before_n = 0.0;
    recording.for_each_tick(0, recording.tick_count(), [&](const record::ops::Tick& tick) {
      const bool paused = (tick.flags & record::paused_flag) != 0;
      if ((tick.flags & record::stale_flag) != 0 && !paused) {
        if (stale++ == 0) ++breaks, at_break_n = before_n;
        const double allowed = std::max(0.0, 1.0 - static_cast<double>(stale - 1) / fading_ticks);
        EXPECT_LE(force_n(tick), allowed * (at_break_n + shaking_n))
            << "tick " << tick.tick << ", stale for " << stale;
        if (stale > fading_ticks) {
          EXPECT_EQ(force_n(tick), 0.0) << "tick " << tick.tick;
        }
      } else {
        stale = 0;
      }
      if (paused) {
        ++rests;
        EXPECT_EQ(force_n(tick), 0.0) << "tick " << tick.tick;
      }
      before_n = force_n(tick);
    });
    EXPECT_GT(rests, 0);  // before the client came
    RecordProperty("breaks", breaks);
  }

  void expect_whole(const std::string& id) {
    const record::Recording recording(server.folder(id) / "recording.ream",
                                      record::Recording::Trust::checked);
    EXPECT_EQ(recording.log().damage(), "");
    expect_no_force_without_a_hand(recording);
    const session::VerifyResult again = server.reaming().verify(server.folder(id) / "recording.ream");
    EXPECT_FALSE(again.difference) << session::difference_words(again.ticks, *again.difference);
    EXPECT_EQ(again.ticks, recording.tick_count());
    const auto metrics = read_json_file(server.folder(id) / "metrics.json");
    EXPECT_EQ(metrics.at("grid_hash"), to_hex(again.grid_hash));
  }

  int told_times(const std::string& id, const std::string& kind) const {
    const record::Recording recording(server.folder(id) / "recording.ream");
    int times = 0;
    for (const record::ops::Event& event : recording.events()) times += event.kind == kind;
    return times;
  }
  void happens(const std::string& driver, const Fault& fault) {
    const std::string id =
        server.run({{"case", "slab"}, {"device", driver}, {"device_profile", "ideal"}, {"force_scale", 1.0}});
    Presser presser(server, id, driver == "browser");
    const auto pressed = [&] { return presser.press().force() > 5.0; };
    LiveServer::until("a force on the hand", pressed);
    fault.happen(presser);
    LiveServer::until("a force on the hand again", pressed);
    LiveServer::until("the session to run again", [&] {
      presser.press();
      return server.get(id).at("state") == "running";
    });
    server.post("/" + id + "/stop");
    fault.told(server.get(id).at("device"));
    const Felt after = presser.press();
    EXPECT_EQ(after.force(), 0.0);
    EXPECT_EQ(after.state, wire::SessionState::stopped);
    expect_whole(id);
    if (fault.lost) {
      EXPECT_GE(told_times(id, "device_lost"), 1);
      EXPECT_GE(told_times(id, "device_back"), 2);  // the first time it is there
    }
  }

  const LiveServer server;
};

TEST_P(DeviceFault, EndsWithoutForceInWordsAndWithEverythingWhole) {
  const auto& [driver, index] = GetParam();
  happens(driver, faults()[index]);
}

INSTANTIATE_TEST_SUITE_P(Drivers, DeviceFault,
                         testing::Combine(testing::Values("network", "browser"),
                                          testing::Range(size_t{0}, faults().size())),
                         [](const auto& about) {
                           std::string name = std::string(std::get<0>(about.param)) + "_" +
                                              faults()[std::get<1>(about.param)].name;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

}  // namespace
}  // namespace ream::test
