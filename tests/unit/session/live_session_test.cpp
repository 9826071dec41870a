#include "session/service/simulation_engine.hpp"

#include <gtest/gtest.h>
#include <linux/capability.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "core/data_folder.hpp"
#include "core/file.hpp"
#include "record/recording.hpp"
#include "score/rubric_store.hpp"
#include "session/folder/recorded_annotations.hpp"
#include "session/live/live_session.hpp"
#include "session/live/session_recovery.hpp"
#include "session/service/session_service.hpp"
#include "session/simulation/session_setup.hpp"
#include "support/expect_error.hpp"
#include "support/recorded_reaming.hpp"

namespace ream::session {
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
class LiveSessionTest : public testing::Test {
 protected:
  LiveSessionTest() {
    fs::create_directories(reaming.data() / "scripts");
    write_file_atomically(reaming.data() / "scripts/push.json",
                          test::RecordedReaming::push("ideal-admittance", 20.0).dump());
    fs::create_directories(sessions_folder(reaming.data()));
  }
  SessionContext context() const { return {reaming.data(), 1, "cpu", sim::Realtime::off, places}; }
  static SessionRequest wanted() { return {{}, "slab", "push", {}}; }
  fs::path folder(const std::string& id) const { return sessions_folder(reaming.data()) / id; }
  void run_for_a_while(const std::string& id, uint32_t ticks) {
    while (is_live(service.get(id).status.state) && service.get(id).status.tick < ticks)
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
  const std::shared_ptr<sim::CpuAllocator> places =
      std::make_shared<sim::CpuAllocator>(std::vector{sim::allowed_cpus().front()});
  SimulationEngine engine{context()};
  store::Database database{"sqlite:" + (reaming.data() / "ream.db").string()};
  SessionService service{engine, {4, 4}, sessions_folder(reaming.data()), database};
};

TEST_F(LiveSessionTest, AScriptThatIsNotThereIsNamedWithoutTheServersFolders) {
  SessionRequest request = wanted();
  request.script = "missing";
  try {
    service.create(request);
    FAIL() << "there is no such script";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::not_found);
    EXPECT_NE(std::string(error.what()).find("no script 'missing'"), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find(reaming.data().string()), std::string::npos) << error.what();
  }
}

TEST_F(LiveSessionTest, NoAcceptedRemarkIsLostAtTheEnd) {
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
    for (const Annotation& annotation : recorded_annotations(folder(id))) kept.push_back(annotation.words);
    EXPECT_EQ(kept, accepted);
  }
}

TEST_F(LiveSessionTest, OneThatWouldMakeRunningOnesMissWaitsUntilThereIsRoom) {
  const std::string stopped = stopped_session(), created = service.create(wanted()).request.id;
  const auto recording = read_binary_file(folder(stopped) / "recording.ream");
  auto other = places->reserve("other", 1000.0);
  test::expect_error(ErrorKind::unavailable, "running sessions use 1000 us", [&] { service.start(created); });
  EXPECT_EQ(service.get(created).status.state, SessionState::created);
  EXPECT_FALSE(fs::exists(folder(created)));
  test::expect_error(ErrorKind::unavailable, "Stop one first", [&] { service.resume(stopped, ""); });
  EXPECT_EQ(service.get(stopped).status.state, SessionState::stopped);
  EXPECT_EQ(read_binary_file(folder(stopped) / "recording.ream"), recording);
  other.reset();
  service.start(created);
  EXPECT_EQ(service.get(created).status.state, SessionState::running);
  service.stop(created);
  EXPECT_NO_THROW(other = places->reserve("other", 1000.0)) << "a session that has ended leaves its place";
}

TEST_F(LiveSessionTest, ASessionThatCouldNotGoOnCanStillBeResumed) {
  const std::string id = stopped_session();
  const auto recording = read_binary_file(folder(id) / "recording.ream");
  {
    const auto blocked = LiveSession::resume(context(), service.get(id).request, "");
    fs::rename(folder(id) / "session.json", folder(id) / "kept");
    fs::create_directories(folder(id) / "session.json" / "in the way");
    test::expect_error(ErrorKind::io, "session.json", [&] { blocked->start(); });
  }
  EXPECT_EQ(read_binary_file(folder(id) / "recording.ream"), recording);
  fs::remove_all(folder(id) / "session.json");
  fs::rename(folder(id) / "kept", folder(id) / "session.json");
  EXPECT_EQ(service.resume(id, "").status.state, SessionState::running);
  service.stop(id);
}

TEST_F(LiveSessionTest, OneThatGetsNoRealTimeStaysWhatItWas) {
  const std::string id = stopped_session();
  SessionContext strict = context();
  strict.realtime = sim::Realtime::require;
  {
    const auto refused = LiveSession::resume(strict, service.get(id).request, "");
    const WithoutRealTime ordinary;
    test::expect_error(ErrorKind::unavailable, "real-time", [&] { refused->start(); });
    EXPECT_EQ(refused->status().state, SessionState::stopped);
    EXPECT_NE(refused->status().fault, "");
  }
  EXPECT_EQ(read_json_file(folder(id) / "session.json").at("state"), "stopped");
  EXPECT_EQ(service.resume(id, "").status.state, SessionState::running);
  service.stop(id);
}

TEST_F(LiveSessionTest, ADamagedRecordingIsLeftAlone) {
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

TEST_F(LiveSessionTest, OneThatWasNeverStartedHasNothingToGoOnFrom) {
  const std::string id = service.create(wanted()).request.id;
  service.stop(id);
  test::expect_error(ErrorKind::not_found, "never started", [&] { service.resume(id, ""); });
  test::expect_error(ErrorKind::not_found, "never started", [&] { service.annotate(id, {"x", "", {}, {}}); });
  EXPECT_FALSE(fs::exists(folder(id)));
}

TEST_F(LiveSessionTest, ManyRemarksAtOnceBehindTheEnd) {
  const std::string id = stopped_session();
  std::vector<std::thread> people;
  for (int i = 0; i < 8; ++i)
    people.emplace_back([&] { EXPECT_NO_THROW(service.annotate(id, {"late", "", {}, {}})); });
  for (std::thread& person : people) person.join();
  EXPECT_EQ(service.annotations(id).size(), 8u);
}

TEST_F(LiveSessionTest, EventsAreRecorded) {
  Simulation simulation(
      build_setup(reaming.request(test::RecordedReaming::push("ideal-admittance", 0.2)), reaming.data()));
  const fs::path out = reaming.folder().path() / "events";
  fs::create_directories(out);
  const std::vector<uint8_t> start = simulation.bone_case.bone.coverage;
  SessionFiles files(simulation, out, start.data(), SessionFiles::Trace::left_out);
  sim::LoopHealth health;
  health.failed_over_tick = 0;
  files.note_failover(0);
  files.finish(health, {SessionState::fault, "the device gave nothing new"});
  const record::Recording recording(out / "recording.ream");
  ASSERT_EQ(recording.events().size(), 2u);
  EXPECT_EQ(recording.events()[0].kind, "failover");
  EXPECT_EQ(recording.events()[1].kind, "fault");
  EXPECT_EQ(recording.events()[1].words, "the device gave nothing new");
}

TEST_F(LiveSessionTest, AnAbandonedHealthyRecordingKeepsItsRemarks) {
  Simulation simulation(
      build_setup(reaming.request(test::RecordedReaming::push("ideal-admittance", 0.2)), reaming.data()));
  const fs::path out = reaming.folder().path() / "abandoned";
  fs::create_directories(out);
  const std::vector<uint8_t> start = simulation.bone_case.bone.coverage;
  SessionFiles files(simulation, out, start.data(), SessionFiles::Trace::left_out);
  record::ops::Annotation remark;
  remark.words = "said";
  files.add(remark);
  files.abandon(SessionState::fault, "why");
  const record::Recording recording(out / "recording.ream");
  ASSERT_EQ(recording.annotations().size(), 1u);
  EXPECT_EQ(recording.end().value().state, "fault");
  EXPECT_EQ(recording.events().at(0).words, "why");
}

TEST_F(LiveSessionTest, APauseIsARecordedCauseAndTheSessionIsStillProven) {
  const std::string id = service.create(wanted()).request.id;
  service.start(id);
  run_for_a_while(id, 400);
  const SessionStatus paused = service.pause(id).status;
  EXPECT_EQ(paused.state, SessionState::paused);
  EXPECT_TRUE(paused.held);
  const double removed = service.metrics(id).at("removed_volume_mm3");
  run_for_a_while(id, paused.tick + 200);
  EXPECT_EQ(service.metrics(id).at("removed_volume_mm3").get<double>(), removed);
  test::expect_error(ErrorKind::conflict, "is paused already", [&] { service.pause(id); });
  const SessionStatus on = service.start(id).status;
  EXPECT_EQ(on.state, SessionState::running);
  EXPECT_FALSE(on.held);
  run_for_a_while(id, on.tick + 300);
  service.stop(id);

  const fs::path path = folder(id) / "recording.ream";
  const record::Recording recording(path);
  std::vector<std::string> kinds;
  for (const record::ops::Event& event : recording.events()) kinds.push_back(event.kind);
  EXPECT_EQ(kinds, (std::vector<std::string>{"paused", "continued"}));
  const VerifyResult verified = reaming.verify(path);
  EXPECT_FALSE(verified.difference) << difference_words(verified.ticks, *verified.difference);
  EXPECT_EQ(verified.ticks, recording.tick_count());
}

TEST_F(LiveSessionTest, AnotherAttemptBeginsWithIntactBoneAndTheSameLabels) {
  SessionRequest request = wanted();
  request.trainee_id = "anna";
  request.trainee = "Anna";
  request.study = "pilot";
  request.participant = "P07";
  request.theatre = true;
  const std::string first = service.create(request).request.id;
  service.start(first);
  run_for_a_while(first, 400);
  const SessionRecord second = service.reset(first);
  EXPECT_EQ(second.status.state, SessionState::running);
  EXPECT_EQ(second.request.reset_of, first);
  EXPECT_EQ(second.request.attempt, 2);
  EXPECT_EQ(service.get(first).status.state, SessionState::stopped);
  run_for_a_while(second.request.id, 200);
  service.stop(second.request.id);
  const nlohmann::json before = read_json_file(folder(first) / "session.json"),
                       after = read_json_file(folder(second.request.id) / "session.json");
  EXPECT_EQ(before.at("followed_by"), second.request.id);
  EXPECT_FALSE(before.contains("attempt"));
  EXPECT_EQ(after.at("attempt"), 2);
  EXPECT_EQ(after.at("reset_of"), first);
  for (const char* key :
       {"trainee_id", "trainee", "study", "participant", "theatre", "start_grid_hash", "force_scale"})
    EXPECT_EQ(before.at(key), after.at(key)) << key;
  for (const std::string& id : {first, second.request.id})
    EXPECT_FALSE(reaming.verify(folder(id) / "recording.ream").difference) << id;
}

TEST_F(LiveSessionTest, LeavesItsScoreWithTheRubricOfTheDataFolderAndTheatreMode) {
  score::Rubric rubric = score::standard_rubric();
  rubric.name = "House";
  EXPECT_EQ(score::RubricStore(rubrics_folder(reaming.data())).save("standard", rubric).version,
            score::standard_rubric().version + 1);
  SessionRequest request = wanted();
  request.theatre = true;
  const std::string id = service.create(request).request.id;
  service.start(id);
  run_for_a_while(id, 300);
  EXPECT_FALSE(fs::exists(folder(id) / "score.json"));
  service.stop(id);
  const nlohmann::json score = read_json_file(folder(id) / "score.json");
  EXPECT_EQ(score.at("theatre"), true);
  EXPECT_EQ(read_json_file(folder(id) / "session.json").at("theatre"), true);
  EXPECT_EQ(score.at("rubric").at("name"), "House");
  EXPECT_EQ(score.at("rubric").at("version"), score::standard_rubric().version + 1);
  EXPECT_EQ(score.at("score").at("version"), score::standard_rubric().version + 1);
  EXPECT_EQ(score.at("metrics"), read_json_file(folder(id) / "metrics.json"));
  EXPECT_EQ(score.at("metrics"), service.metrics(id));
}

TEST_F(LiveSessionTest, StoppedAtOnceIsScoredByWhatItSays) {
  const std::string id = service.create(wanted()).request.id;
  service.start(id);
  service.stop(id);
  const nlohmann::json score = read_json_file(folder(id) / "score.json");
  EXPECT_EQ(score.at("score").at("outcome"), "undecided");
  for (const auto& [key, value] : score.at("metrics").items())
    if (value.is_null()) {
      EXPECT_FALSE(score.at("metrics").at("missing").value(key, "").empty()) << key;
    }
}

TEST_F(LiveSessionTest, LabelsAreWrittenDownWhileItRunsAndAtTheEnd) {
  const std::string id = service.create(wanted()).request.id;
  service.change(id, {"before", {}, {}, {}});
  service.start(id);
  EXPECT_EQ(read_json_file(folder(id) / "session.json").at("title"), "before");
  run_for_a_while(id, 100);
  service.change(id, {"while it runs", {}, "Anna", true});
  const uint32_t tick = service.get(id).status.tick;
  run_for_a_while(id, tick + 200);
  EXPECT_EQ(read_json_file(folder(id) / "session.json").at("title"), "while it runs");
  service.change(id, {"at the end", {}, {}, {}});
  service.stop(id);
  nlohmann::json session = read_json_file(folder(id) / "session.json");
  EXPECT_EQ(session.at("title"), "at the end");
  EXPECT_EQ(session.at("trainee"), "Anna");
  EXPECT_EQ(session.at("keep"), true);
  EXPECT_EQ(service.change(id, {"after", {}, "", false}).request.title, "after");
  session = read_json_file(folder(id) / "session.json");
  EXPECT_EQ(session.at("title"), "after");
  EXPECT_FALSE(session.contains("trainee"));
  EXPECT_FALSE(session.contains("keep"));
  EXPECT_EQ(session.at("state"), "stopped");
}

}  // namespace
}  // namespace ream::session
