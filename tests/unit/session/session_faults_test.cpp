#include <gtest/gtest.h>

#include <functional>
#include <thread>

#include "core/clock.hpp"
#include "core/data_folder.hpp"
#include "record/recording.hpp"
#include "session/folder/black_box_files.hpp"
#include "session/live/live_session.hpp"
#include "session/service/session_service.hpp"
#include "support/device_wire.hpp"
#include "support/recorded_reaming.hpp"

namespace ream::session {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> kinds_of_events(const fs::path& recording_file) {
  const record::Recording recording(recording_file);
  std::vector<std::string> kinds;
  for (const record::ops::Event& event : recording.events()) kinds.push_back(event.kind);
  return kinds;
}

/// The client of a session's device, in this process.
class Client {
 public:
  explicit Client(RunningSession& session) : socket_(session.connect_device()) {
    socket_->on_open([] {});
    send(test::greeting_bytes(1, "test"));
  }
  ~Client() { socket_->on_close(); }
  void say() {
    test::HandleWords words;
    words.sequence = ++sequence_;
    send(test::handle_bytes(words));
    while (socket_->next()) {
    }
  }

 private:
  void send(const std::string& message) { socket_->on_message(std::as_bytes(std::span(message))); }
  std::unique_ptr<net::WebSocketSession> socket_;
  uint32_t sequence_ = 0;
};

class SessionFaults : public testing::Test {
 protected:
  SessionFaults() { fs::create_directories(sessions_folder(reaming.data())); }
  std::unique_ptr<LiveSession> network_session() {
    SessionRequest request;
    request.id = "faulty";
    request.case_id = "slab";
    request.script = "practice";
    request.device = "network";
    return LiveSession::create(SessionContext{reaming.data(), 1, "cpu", sim::Realtime::off}, request);
  }
  fs::path folder() const { return sessions_folder(reaming.data()) / "faulty"; }
  static void until(const std::function<bool()>& reached) {
    for (int i = 0; i < 12000 && !reached(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_TRUE(reached());
  }

  const test::RecordedReaming reaming;
};

/// Nobody there, there, gone, there again: page and REST say each, and the recording keeps them.
TEST_F(SessionFaults, ADevicesComingAndGoingIsToldAndRecorded) {
  const auto session = network_session();
  session->start();
  until([&] { return session->status().device.state == "lost"; });
  EXPECT_EQ(session->status().fault, device_awaited_words);
  EXPECT_EQ(session->status().state, SessionState::paused);
  for (int visit = 0; visit < 2; ++visit) {
    Client client(*session);
    until([&] {
      client.say();
      return session->status().device.state == "fresh";
    });
    EXPECT_EQ(session->status().fault, "");
    until([&] { return session->status().device.state == "lost"; });
    EXPECT_EQ(session->status().fault, device_lost_words);
    EXPECT_EQ(session->status().state, SessionState::paused);
  }
  session->stop();
  EXPECT_EQ(session->status().state, SessionState::stopped);
  EXPECT_EQ(session->status().fault, "");
  const std::vector<std::string> kinds = kinds_of_events(folder() / "recording.ream");
  ASSERT_GE(kinds.size(), 4u);
  for (size_t i = 0; i < kinds.size(); ++i)
    EXPECT_EQ(kinds[i], i % 2 == 0 ? "device_back" : "device_lost") << i;
  EXPECT_GE(black_boxes_in(folder()).size(), 1u);
  EXPECT_FALSE(reaming.verify(folder() / "recording.ream").difference.has_value());
}

TEST_F(SessionFaults, ASpindleStartedUnderLoadIsMarkedInTheRecording) {
  nlohmann::json script = test::RecordedReaming::push("ideal");
  script["buttons"] = {{{"t_s", 0.0}, {"spindle", false}}, {{"t_s", 1.5}, {"spindle", true}}};
  test::RecordedReaming other;
  const fs::path recording = other.record(script);
  EXPECT_EQ(kinds_of_events(recording), (std::vector<std::string>{"spindle_loaded", "spindle_stalled"}));
  EXPECT_EQ(record::Recording(recording).events().front().tick, 1500u);
  script["buttons"] = {{{"t_s", 0.0}, {"spindle", true}}};
  EXPECT_EQ(kinds_of_events(other.record(script)), std::vector<std::string>{});
}

}  // namespace
}  // namespace ream::session
