#include "session/replay/replay_session.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "case/case.hpp"
#include "core/clock.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "record/recording.hpp"
#include "session/live/headless_run.hpp"
#include "session/simulation/session_setup.hpp"
#include "support/damage.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_bone.hpp"
#include "unit/stream/viewer.hpp"

namespace ream::session {
namespace {

using test::expect_error;

/// A short session on a slab, recorded in a data folder.
class ReplaySessionTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<test::TemporaryFolder>();
    case_::Case c;
    c.id = c.name = c.source = "slab";
    c.bone = test::slab({48, 48, 24}, 0.5, 8.0, 0.6);
    c.plan = test::slab_plan(c.bone, 8.0);
    c.plan->reamer = "sphere 8";
    case_::save_case(c, cases_folder(folder_->path()) / "slab");
    const auto script = folder_->write("scripts/press.json", R"({"device": "hand", "duration_s": 3.2,
        "vibration": {"source": "off"}, "hand": {"start_mm": [0, 0, -1], "force_profile": [{"t_s": 0, "force_n": 30}]}})");
    RunRequest request;
    request.case_name = "slab";
    request.script_name = script.string();
    request.backend = "cpu";
    Simulation simulation(build_setup(request, folder_->path()));
    const auto session = sessions_folder(folder_->path()) / "abcdefgh";
    std::filesystem::create_directories(session);
    const std::vector<uint8_t> start = simulation.bone_case.bone.coverage;
    metrics_ = run_headless(simulation, start, session, false).metrics;
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static SessionContext context() {
    SessionContext context;
    context.data = folder_->path();
    context.server_epoch = 7;
    return context;
  }
  static ReplayRequest request(const std::string& of = "abcdefgh") {
    return {"rabcdefgh", of, "slab", "press"};
  }

  /// Waits until the replay stands there and rests.
  static void until(const ReplaySession& replay, double position_s) {
    while (replay.status().position_s != position_s || replay.status().playing)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }

  static inline std::unique_ptr<test::TemporaryFolder> folder_;
  static inline nlohmann::json metrics_;
};

TEST_F(ReplaySessionTest, AtItsEndItsMetricsAreTheSessions) {
  ASSERT_GT(metrics_.at("removed_volume_mm3").get<double>(), 1.0);
  ReplaySession replay(context(), request());
  EXPECT_EQ(replay.status().duration_s, metrics_.at("duration_s").get<double>());
  EXPECT_EQ(replay.metrics().at("removed_volume_mm3"), 0.0);
  replay.change({true, 16.0, 1.0});
  until(replay, replay.status().duration_s);
  while (replay.metrics().at("grid_hash").is_null())
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_EQ(replay.metrics(), metrics_);
}

TEST_F(ReplaySessionTest, TellsViewersWhereItStandsAndThatItHasEnded) {
  ReplaySession replay(context(), request());
  const auto stream = replay.subscribe(1);
  stream->on_open([] {});
  stream::Viewer viewer;
  wire::SessionState state{};
  uint32_t position_ticks = 0;
  std::string replay_of;
  const auto pull = [&] {
    while (const auto message = stream->next()) {
      viewer.receive(*message);
      const wire::ServerMessage* m = wire::GetServerMessage((*message)->data());
      if (const wire::Hello* hello = m->body_as_Hello()) replay_of = hello->replay_of()->str();
      if (const wire::Telemetry* t = m->body_as_Telemetry()) {
        state = t->state();
        position_ticks = t->playback()->position_ticks();
      }
    }
  };
  replay.change({{}, {}, 1.5});
  while (position_ticks != 1500) {
    pull();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_EQ(replay_of, "abcdefgh");
  EXPECT_EQ(state, wire::SessionState::replaying);
  EXPECT_EQ(viewer.key_completes, 1);
  EXPECT_EQ(viewer.blocks_with_classes, viewer.blocks_received);
  EXPECT_EQ(replay.status().unwatched_s, 0.0);
  replay.stop();
  pull();
  EXPECT_EQ(state, wire::SessionState::stopped);
  replay.stop();
}

/// A copy of the session whose recording has a damaged chunk, which begins at `damaged_s`.
class DamagedReplayTest : public ReplaySessionTest {
 protected:
  DamagedReplayTest() {
    const auto sessions = sessions_folder(folder_->path());
    std::filesystem::remove_all(sessions / "damaged");
    std::filesystem::copy(sessions / "abcdefgh", sessions / "damaged");
    const record::ChunkPlace place = record::Recording(path()).log().chunks().at(7);
    EXPECT_FALSE(place.has_notes);
    damaged_s = place.first_tick * tick_s;
    test::damage(path(), place.offset + 60);
  }
  static std::filesystem::path path() {
    return sessions_folder(folder_->path()) / "damaged" / "recording.ream";
  }
  /// Waits until a fault is told.
  static std::string fault_of(const ReplaySession& replay) {
    while (replay.status().fault.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return replay.status().fault;
  }
  static size_t count(const std::string& text, const std::string& part) {
    size_t n = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
  }

  double damaged_s = 0.0;
};

TEST_F(DamagedReplayTest, AJumpIntoDamageRestsWhereItWasAndTheReplayGoesOn) {
  testing::internal::CaptureStderr();
  {
    ReplaySession replay(context(), request("damaged"));
    replay.change({{}, {}, 1.0});
    while (replay.metrics().at("grid_hash").is_null())
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    for (const double into_s : {damaged_s + 0.1, 3.0}) {
      replay.change({{}, {}, into_s});
      EXPECT_NE(fault_of(replay).find("damaged"), std::string::npos);
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      EXPECT_FALSE(replay.status().fault.empty());
      EXPECT_EQ(replay.status().position_s, 1.0);
    }
    replay.change({{}, {}, 0.5});
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(replay.status().fault, "");
    EXPECT_EQ(replay.status().position_s, 0.5);
    EXPECT_NO_THROW(replay.metrics());
    replay.change({true, 16.0, {}});
    fault_of(replay);
    until(replay, damaged_s);
  }
  EXPECT_EQ(count(testing::internal::GetCapturedStderr(), "replay of session"), 1u);
}

TEST_F(DamagedReplayTest, DamageIsToldBeforeItIsReached) {
  const ReplaySession replay(context(), request("damaged"));
  while (replay.status().warning.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_EQ(replay.status().fault, "");
  EXPECT_NE(replay.status().warning.find("is damaged"), std::string::npos);
  ASSERT_FALSE(replay.marks().empty());
  EXPECT_EQ(replay.marks().back().kind, "damaged");
  EXPECT_EQ(replay.marks().back().at_s, damaged_s);
  EXPECT_EQ(replay.marks().back().words, replay.status().warning);
}

TEST_F(DamagedReplayTest, ACutEndIsToldToo) {
  const auto whole = sessions_folder(folder_->path()) / "abcdefgh" / "recording.ream";
  std::filesystem::copy_file(whole, path(), std::filesystem::copy_options::overwrite_existing);
  std::filesystem::resize_file(path(), record::Recording(whole).log().chunks().back().offset + 70);
  const ReplaySession replay(context(), request("damaged"));
  EXPECT_FALSE(replay.status().warning.empty());
  ASSERT_FALSE(replay.marks().empty());
  EXPECT_EQ(replay.marks().back().kind, "damaged");
  EXPECT_EQ(replay.marks().back().at_s, replay.status().duration_s);
}

TEST_F(ReplaySessionTest, AWholeRecordingHasNoWarning) {
  ReplaySession replay(context(), request());
  replay.change({{}, {}, replay.status().duration_s});
  replay.metrics();  // by now all has been read
  EXPECT_EQ(replay.status().warning, "");
  for (const ReplayMark& mark : replay.marks()) EXPECT_NE(mark.kind, "damaged");
}

TEST_F(ReplaySessionTest, RefusesWhatItCannotShow) {
  expect_error(ErrorKind::not_found, "nobody", [] { ReplaySession(context(), request("nobody")); });
  folder_->write("sessions/broken/recording.ream", "no recording");
  EXPECT_THROW(ReplaySession(context(), request("broken")), Error);
  ReplaySession replay(context(), request());
  expect_error(ErrorKind::invalid_input, "position_s", [&] { replay.change({{}, {}, 1000.0}); });
}

TEST_F(ReplaySessionTest, RefusesACaseThatHasChanged) {
  const auto folder = cases_folder(folder_->path()) / "slab";
  case_::Case c = case_::load_case(folder);
  case_::Case changed = c;
  changed.bone.coverage[changed.bone.grid.index(24, 24, 5)] = 7;
  case_::save_case(changed, folder, true);
  expect_error(ErrorKind::conflict, "slab", [] { ReplaySession(context(), request()); });
  case_::save_case(c, folder, true);
  EXPECT_NO_THROW(ReplaySession(context(), request()));
}

}  // namespace
}  // namespace ream::session
