#include "app/reaming_session.hpp"

#include <gtest/gtest.h>
#include <linux/capability.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "api/recorded_annotations.hpp"
#include "api/session_service.hpp"
#include "app/data_folder.hpp"
#include "app/session_recovery.hpp"
#include "core/file.hpp"
#include "record/recording.hpp"
#include "support/expect_error.hpp"
#include "support/recorded_reaming.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

/// Takes from the calling thread, and those it starts, what real-time scheduling needs.
class WithoutRealTime {
 public:
  WithoutRealTime() {
    ::getrlimit(RLIMIT_RTPRIO, &limit_before_);
    const rlimit none{0, limit_before_.rlim_max};
    ::setrlimit(RLIMIT_RTPRIO, &none);
    ::syscall(SYS_capget, &who_, before_);
    __user_cap_data_struct fewer[2] = {before_[0], before_[1]};
    fewer[0].effective &= ~(1u << CAP_SYS_NICE);
    ::syscall(SYS_capset, &who_, fewer);
  }
  ~WithoutRealTime() {
    ::syscall(SYS_capset, &who_, before_);
    ::setrlimit(RLIMIT_RTPRIO, &limit_before_);
  }

 private:
  __user_cap_header_struct who_{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct before_[2] = {};
  rlimit limit_before_{};
};

/// Live sessions on a slab of bone.
class ReamingSessionTest : public testing::Test {
 protected:
  ReamingSessionTest() {
    fs::create_directories(reaming.data() / "scripts");
    write_file_atomically(reaming.data() / "scripts/push.json",
                          test::RecordedReaming::push("ideal-admittance", 20.0).dump());
    fs::create_directories(sessions_folder(reaming.data()));
  }
  api::SessionMakers makers() {
    return {[this](const api::SessionRequest& request) {
              return std::make_unique<ReamingSession>(house(), request);
            },
            [this](const api::SessionRequest& request, const std::string& reamer) {
              return std::make_unique<ReamingSession>(house(), request, reamer);
            }};
  }
  SessionHouse house() const { return {reaming.data(), 1, "cpu", sim::Realtime::off, places}; }
  static api::SessionRequest wanted() { return {{}, "slab", "push", {}}; }
  fs::path folder(const std::string& id) const { return sessions_folder(reaming.data()) / id; }
  void run_for_a_while(const std::string& id, uint32_t ticks) {
    while (api::is_live(service.get(id).status.state) && service.get(id).status.tick < ticks)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::string stopped_session() {
    const std::string id = service.create(wanted()).request.id;
    service.start(id);
    run_for_a_while(id, 300);
    service.stop(id);
    return id;
  }

  const test::RecordedReaming reaming;
  const std::shared_ptr<sim::LoopPlaces> places =
      std::make_shared<sim::LoopPlaces>(std::vector{sim::allowed_cpus().front()});
  api::SessionService service{makers(), {4, 4}, sessions_folder(reaming.data())};
};

TEST_F(ReamingSessionTest, NoAcceptedRemarkIsLostAtTheEnd) {
  for (int round = 0; round < 3; ++round) {
    const std::string id = service.create(wanted()).request.id;
    service.start(id);
    std::atomic<bool> over{false};
    std::vector<std::string> accepted;
    std::thread remarks([&] {
      while (!over) {
        const std::string words = "remark " + std::to_string(accepted.size());
        service.annotate(id, {words, "", {}, {}});
        accepted.push_back(words);
      }
    });
    run_for_a_while(id, 200);
    service.stop(id);
    over = true;
    remarks.join();
    std::vector<std::string> kept;
    for (const api::Annotation& annotation : api::recorded_annotations(folder(id)))
      kept.push_back(annotation.words);
    EXPECT_EQ(kept, accepted);
  }
}

TEST_F(ReamingSessionTest, OneThatWouldMakeRunningOnesMissWaitsUntilThereIsRoom) {
  const std::string stopped = stopped_session(), created = service.create(wanted()).request.id;
  const auto recording = read_binary_file(folder(stopped) / "recording.ream");
  auto other = places->take("other", 1000.0);
  test::expect_error(ErrorKind::unavailable, "running sessions use 1000 us", [&] { service.start(created); });
  EXPECT_EQ(service.get(created).status.state, api::SessionState::created);
  EXPECT_FALSE(fs::exists(folder(created)));
  test::expect_error(ErrorKind::unavailable, "Stop one first", [&] { service.resume(stopped, ""); });
  EXPECT_EQ(service.get(stopped).status.state, api::SessionState::stopped);
  EXPECT_EQ(read_binary_file(folder(stopped) / "recording.ream"), recording);
  other.reset();
  service.start(created);
  EXPECT_EQ(service.get(created).status.state, api::SessionState::running);
  service.stop(created);
  EXPECT_NO_THROW(other = places->take("other", 1000.0)) << "a session that has ended leaves its place";
}

TEST_F(ReamingSessionTest, ASessionThatCouldNotGoOnCanStillBeResumed) {
  const std::string id = stopped_session();
  const auto recording = read_binary_file(folder(id) / "recording.ream");
  {
    ReamingSession blocked(house(), service.get(id).request, "");
    fs::rename(folder(id) / "session.json", folder(id) / "kept");
    fs::create_directories(folder(id) / "session.json" / "in the way");
    test::expect_error(ErrorKind::io, "session.json", [&] { blocked.start(); });
  }
  EXPECT_EQ(read_binary_file(folder(id) / "recording.ream"), recording);
  fs::remove_all(folder(id) / "session.json");
  fs::rename(folder(id) / "kept", folder(id) / "session.json");
  EXPECT_EQ(service.resume(id, "").status.state, api::SessionState::running);
  service.stop(id);
}

TEST_F(ReamingSessionTest, OneThatGetsNoRealTimeStaysWhatItWas) {
  const std::string id = stopped_session();
  SessionHouse strict = house();
  strict.realtime = sim::Realtime::require;
  {
    ReamingSession refused(strict, service.get(id).request, "");
    const WithoutRealTime ordinary;
    test::expect_error(ErrorKind::unavailable, "real-time", [&] { refused.start(); });
    EXPECT_EQ(refused.status().state, api::SessionState::stopped);
    EXPECT_NE(refused.status().fault, "");
  }
  EXPECT_EQ(read_json_file(folder(id) / "session.json").at("state"), "stopped");
  EXPECT_EQ(service.resume(id, "").status.state, api::SessionState::running);
  service.stop(id);
}

TEST_F(ReamingSessionTest, ADamagedRecordingIsLeftAlone) {
  const std::string id = stopped_session();
  const fs::path path = folder(id) / "recording.ream";
  const record::Recording whole(path);
  auto bytes = read_binary_file(path);
  bytes[whole.log().chunks().at(1).offset] ^= std::byte{1};
  write_file_atomically(path, bytes);
  test::expect_error(ErrorKind::conflict, "damaged", [&] { service.annotate(id, {"late", "", {}, {}}); });
  test::expect_error(ErrorKind::conflict, "damaged", [&] { service.resume(id, ""); });
  EXPECT_EQ(read_binary_file(path), bytes);
}

TEST_F(ReamingSessionTest, OneThatWasNeverStartedHasNothingToGoOnFrom) {
  const std::string id = service.create(wanted()).request.id;
  service.stop(id);
  test::expect_error(ErrorKind::not_found, "never started", [&] { service.resume(id, ""); });
  test::expect_error(ErrorKind::not_found, "never started", [&] { service.annotate(id, {"x", "", {}, {}}); });
  EXPECT_FALSE(fs::exists(folder(id)));
}

TEST_F(ReamingSessionTest, ManyRemarksAtOnceBehindTheEnd) {
  const std::string id = stopped_session();
  std::vector<std::thread> people;
  for (int i = 0; i < 8; ++i)
    people.emplace_back([&] { EXPECT_NO_THROW(service.annotate(id, {"late", "", {}, {}})); });
  for (std::thread& person : people) person.join();
  EXPECT_EQ(service.annotations(id).size(), 8u);
}

TEST_F(ReamingSessionTest, EventsAreRecorded) {
  Rig rig(reaming.request(test::RecordedReaming::push("ideal-admittance", 0.2)), reaming.data());
  const fs::path out = reaming.folder().path() / "events";
  fs::create_directories(out);
  const std::vector<uint8_t> start = rig.bone_case.bone.coverage;
  SessionFiles files(rig, out, start.data(), SessionFiles::Trace::left_out);
  sim::LoopHealth health;
  health.failed_over_tick = 0;
  files.note_failover(0);
  files.finish(health, {{"state", "fault"}, {"fault", "the device gave nothing new"}});
  const record::Recording recording(out / "recording.ream");
  ASSERT_EQ(recording.events().size(), 2u);
  EXPECT_EQ(recording.events()[0].kind, "failover");
  EXPECT_EQ(recording.events()[1].kind, "fault");
  EXPECT_EQ(recording.events()[1].words, "the device gave nothing new");
}

TEST_F(ReamingSessionTest, AnAbandonedHealthyRecordingKeepsItsRemarks) {
  Rig rig(reaming.request(test::RecordedReaming::push("ideal-admittance", 0.2)), reaming.data());
  const fs::path out = reaming.folder().path() / "abandoned";
  fs::create_directories(out);
  const std::vector<uint8_t> start = rig.bone_case.bone.coverage;
  SessionFiles files(rig, out, start.data(), SessionFiles::Trace::left_out);
  record::ops::Annotation remark;
  remark.words = "said";
  files.add(remark);
  files.abandon("fault", "why");
  const record::Recording recording(out / "recording.ream");
  ASSERT_EQ(recording.annotations().size(), 1u);
  EXPECT_EQ(recording.end().value().state, "fault");
  EXPECT_EQ(recording.events().at(0).words, "why");
}

}  // namespace
}  // namespace ream::app
