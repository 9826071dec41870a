#include "session/replay/verify_replay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/hash.hpp"
#include "geometry/mesh_io.hpp"
#include "gpu/device.hpp"
#include "record/replay_device.hpp"
#include "record/tick_report.hpp"
#include "session/replay/review_recording.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/recorded_session.hpp"
#include "session/simulation/recorded_setup.hpp"
#include "session/simulation/session_setup.hpp"
#include "sim/settings.hpp"
#include "support/changed_recording.hpp"
#include "support/expect_error.hpp"
#include "support/recorded_reaming.hpp"
#include "support/watched_backend.hpp"

namespace ream::session {
namespace {

using nlohmann::json;
using record::ops::Tick;
using test::RecordedReaming;

std::vector<std::string> every_backend() {
  std::vector<std::string> backends{"cpu"};
  for (const gpu::Device& device : gpu::list_devices())
    backends.push_back("opencl:" + std::to_string(device.index));
  return backends;
}

void expect_the_same_everywhere(const RecordedReaming& reaming, const std::filesystem::path& path) {
  const record::Recording recording(path);
  const case_::Case native = recorded_case(recording, "", reaming.data());
  const Review review = review_recording(recording, native,
                                         recorded_glenoid(recording, native, "", reaming.data()), UINT32_MAX);
  EXPECT_TRUE(review.reaming_depth_mm);
  EXPECT_FALSE(review.difference.has_value());
  EXPECT_GT(review.removed_volume_mm3, 0.05);
  EXPECT_EQ(review.ticks, recording.tick_count());
  ASSERT_GE(every_backend().size(), 2u) << "no OpenCL device: install pocl-opencl-icd";
  for (const std::string& backend : every_backend()) {
    const VerifyResult result = reaming.verify(path, backend);
    SCOPED_TRACE(result.backend);
    EXPECT_FALSE(result.difference.has_value()) << difference_words(result.ticks, *result.difference);
    EXPECT_EQ(result.ticks, recording.tick_count());
    EXPECT_EQ(result.grid_hash, review.grid_hash);
    EXPECT_EQ(result.session_hash, review.session_hash);
    EXPECT_TRUE(result.left_out.empty());
  }
}

void expect_difference(const VerifyResult& result, uint32_t tick, const std::string& kind,
                       const std::string& field) {
  ASSERT_TRUE(result.difference.has_value());
  EXPECT_EQ(result.ticks, tick);
  EXPECT_EQ(result.difference->kind, kind);
  EXPECT_EQ(result.difference->field, field);
  EXPECT_NE(result.difference->recorded, result.difference->found);
}

class VerifyDevices : public testing::TestWithParam<std::string> {};

TEST_P(VerifyDevices, TheSameOnEveryBackend) {
  RecordedReaming reaming;
  expect_the_same_everywhere(reaming, reaming.record(RecordedReaming::push(GetParam())));
}

INSTANTIATE_TEST_SUITE_P(Profiles, VerifyDevices,
                         testing::Values("ideal", "touch", "omega.6", "kuka-iiwa-7", "hapticmaster",
                                         "ideal-admittance"),
                         [](const auto& profile) {
                           std::string name = profile.param;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

/// Bone is cut as its case says, unless the script says it, and a recording goes on as it was made.
TEST(VerifyReplay, TheCaseSaysHowItsBoneIsCut) {
  const auto edge_mm = [](const RecordedReaming& reaming, json script) {
    return build_setup(reaming.request(script), reaming.data()).settings.feed.cutting.edge_reference_mm;
  };
  RecordedReaming reaming;
  const std::filesystem::path folder = reaming.data() / "cases/slab";
  const json script = RecordedReaming::push("ideal");
  EXPECT_EQ(edge_mm(reaming, script), force::CuttingCoefficients{}.edge_reference_mm);
  case_::Case c = case_::load_case(folder);
  c.cutting = force::CuttingCoefficients{};
  c.cutting->edge_reference_mm = 25.0;
  case_::save_bone(c, folder);
  EXPECT_EQ(edge_mm(reaming, script), 25.0);
  json compared = script;
  compared["cutting"] = {{"edge_reference_mm", 50.0}};
  EXPECT_EQ(edge_mm(reaming, compared), 50.0);

  const std::filesystem::path path = reaming.record(script);
  c.cutting.reset();
  case_::save_bone(c, folder);
  EXPECT_FALSE(reaming.verify(path, "cpu").difference.has_value());
}

/// The recording in the loop's own hands: what it sends is reamed, recorded and scored as the first time.
TEST(VerifyReplay, ARecordingIsADevice) {
  for (const char* profile : {"touch", "ideal-admittance"}) {
    SCOPED_TRACE(profile);
    RecordedReaming reaming;
    const std::filesystem::path path = reaming.record(RecordedReaming::push(profile));
    const record::Recording recording(path);
    SimulationSetup parts = recorded_setup(recording, recording.segments().front(),
                                           recorded_case(recording, "", reaming.data()), {}, "cpu");
    device::DeviceTraits traits;
    traits.profile = profile;
    parts.device = std::make_unique<record::ReplayDevice>(recording, 0, recording.tick_count(), traits);
    Simulation simulation(std::move(parts));
    simulation.state.handle_given = true;
    const record::Recording again(reaming.record(simulation));
    const auto ticks = recording.ticks(0, UINT32_MAX);
    EXPECT_EQ(again.ticks(0, UINT32_MAX), ticks);
    EXPECT_EQ(again.checkpoints(), recording.checkpoints());
  }
}

/// Falls silent three times while it presses: 8 ms are held, 30 ms fade the force, 200 ms lose the device.
class HaltingDevice final : public device::HapticDevice {
 public:
  explicit HaltingDevice(std::unique_ptr<device::HapticDevice> inner) : inner_(std::move(inner)) {}
  const device::DeviceTraits& traits() const noexcept override { return inner_->traits(); }
  void open() override { inner_->open(); }
  void close() noexcept override { inner_->close(); }
  device::DeviceStatus read(device::DeviceInput& input) noexcept override {
    const int tick = tick_++;
    const bool silent =
        (tick >= 3000 && tick < 3008) || (tick >= 3300 && tick < 3330) || (tick >= 3600 && tick < 3800);
    silent_ms_ = silent ? silent_ms_ + 1 : 0;
    input.age_ms = silent_ms_;
    return silent_ms_ > 0 ? device::DeviceStatus::ok : inner_->read(input);
  }
  device::DeviceStatus write(const device::DeviceOutput& output) noexcept override {
    return inner_->write(output);
  }
  void session_paused(bool paused) noexcept override { inner_->session_paused(paused); }
  void take_force_away() noexcept override { inner_->take_force_away(); }
  double closing_ms() const noexcept override { return inner_->closing_ms(); }
  void use_priority(int fifo) noexcept override { inner_->use_priority(fifo); }

 private:
  std::unique_ptr<device::HapticDevice> inner_;
  int tick_ = 0, silent_ms_ = 0;
};

/// What was too old is a cause like any other: force and bone come out the same on every backend.
TEST(VerifyReplay, ADeviceThatFallsSilentNowAndThen) {
  for (const char* profile : {"touch", "ideal", "ideal-admittance"}) {
    SCOPED_TRACE(profile);
    RecordedReaming reaming;
    SimulationSetup parts = build_setup(reaming.request(RecordedReaming::push(profile, 4.5)), reaming.data());
    parts.device = std::make_unique<HaltingDevice>(std::move(parts.device));
    Simulation simulation(std::move(parts));
    const std::filesystem::path path = reaming.record(simulation);
    uint32_t stale = 0, lost = 0;
    record::Recording(path).for_each_tick(0, UINT32_MAX, [&](const Tick& tick) {
      const bool is_stale = (tick.flags & record::stale_flag) != 0;
      const bool is_paused = (tick.flags & record::paused_flag) != 0;
      stale += is_stale;
      lost += is_stale && is_paused;
    });
    EXPECT_EQ(stale, 21u + 191u);
    EXPECT_EQ(lost, 151u);
    expect_the_same_everywhere(reaming, path);
  }
}

TEST(VerifyReplay, ARobotsRun) {
  RecordedReaming reaming;
  json script = RecordedReaming::push("ideal-admittance");
  script.erase("hand");
  script["device"] = "robot";
  script["robot"] = {{"start_mm", {0.0, 0.0, -0.8}}, {"ramp_s", 0.5}, {"depth_mm", 0.3}};
  expect_the_same_everywhere(reaming, reaming.record(script));
}

TEST(VerifyReplay, RemovalByDecay) {
  RecordedReaming reaming;
  RunRequest request = reaming.request(RecordedReaming::push("ideal"));
  request.removal = sim::RemovalLaw::decay;
  Simulation simulation(build_setup(request, reaming.data()));
  expect_the_same_everywhere(reaming, reaming.record(simulation));
}

TEST(VerifyReplay, GuidedInBoneThatGivesWay) {
  for (const case_::GuideKind guide : {case_::GuideKind::nipple, case_::GuideKind::pin}) {
    SCOPED_TRACE(case_::to_text(guide));
    case_::Plan plan = RecordedReaming::small_plan();
    plan.guide = guide;
    RecordedReaming reaming(plan);
    json script = RecordedReaming::push("omega.6");
    script["mount"] = "chest_wall";
    script["hand"]["tilt_deg"] = {3.0, 2.0, 0.0};
    expect_the_same_everywhere(reaming, reaming.record(script));
  }
}

TEST(VerifyReplay, EveryFeedModelAndVibration) {
  for (const char* model : {"thesis", "oblique"}) {
    SCOPED_TRACE(model);
    RecordedReaming reaming;
    json script = RecordedReaming::push("sigma.7");
    script["feed_model"] = model;
    script["vibration"] = {{"source", "synthesized"}};
    expect_the_same_everywhere(reaming, reaming.record(script));
  }
}

TEST(VerifyReplay, ASessionWhoseDeviceFailed) {
  RecordedReaming reaming;
  Simulation simulation(build_setup(reaming.request(RecordedReaming::push("omega.6")), reaming.data()));
  simulation.state.reserve =
      sim::make_cpp_backend(simulation.model, simulation.bone_case.bone, simulation.state.cells);
  simulation.state.backend.narrow_phase =
      std::make_unique<test::FailingNarrowPhase>(std::move(simulation.state.backend.narrow_phase), 300);
  const auto path = reaming.record(simulation);
  ASSERT_GT(simulation.state.failed_over_tick, 0);
  expect_the_same_everywhere(reaming, path);
}

TEST(VerifyReplay, ReamersInTurnOneOfThemAMesh) {
  RecordedReaming reaming;
  const json script = RecordedReaming::push("omega.6");
  const auto path = reaming.record(script);
  reaming.go_on(path, script, "sphere 6,4");
  const std::filesystem::path mesh = reaming.folder().path() / "cap.ply";
  write_ply(mesh, shell::make_tool("sphere 9,4").mesh);
  reaming.go_on(path, script, mesh.string());
  std::filesystem::remove(mesh);
  const record::Recording recording(path);
  ASSERT_EQ(recording.segments().size(), 3u);
  EXPECT_EQ(recording.tick_count(), 9000u);
  expect_the_same_everywhere(reaming, path);
}

TEST(VerifyReplay, GoesNoFartherThanAsked) {
  RecordedReaming reaming;
  const auto path = reaming.record(RecordedReaming::push("ideal"));
  const record::Recording recording(path);
  VerifyRequest request;
  request.until_tick = 333;
  const VerifyResult result = verify_replay(recording, recorded_case(recording, "", reaming.data()), request);
  EXPECT_EQ(result.ticks, 333u);
  EXPECT_EQ(result.session_hash, recording.ticks(332, 333).at(0).session_hash);
}

class Deceived : public testing::Test {
 protected:
  template <typename Op, typename Change>
  std::filesystem::path changed(Change change) {
    const auto path = reaming_.folder().path() / "changed.ream";
    std::filesystem::remove(path);
    test::change_recording(path_, path, test::of<Op>(change));
    return path;
  }
  template <typename Change>
  std::filesystem::path with_changed_tick(uint32_t tick, Change change) {
    return changed<Tick>([=](Tick& op) {
      if (op.tick == tick) change(op);
    });
  }

  /// Kept, so that making them again costs nothing.
  static inline const auto tracks = force::make_vibration_tracks({}, 1);
  RecordedReaming reaming_;
  std::filesystem::path path_ = reaming_.record([] {
    json script = RecordedReaming::push("ideal");
    script["vibration"] = {{"source", "synthesized"}};
    return script;
  }());
};

TEST_F(Deceived, AnUnchangedCopyIsTheSame) {
  EXPECT_FALSE(reaming_.verify(changed<Tick>([](Tick&) {})).difference.has_value());
}

TEST_F(Deceived, OneInputThatWasNotSo) {
  // On bone every coordinate follows every other; the first that differs is named.
  const VerifyResult pushed =
      reaming_.verify(with_changed_tick(400, [](Tick& t) { t.world_from_handle.translation_nm[2] -= 200; }));
  ASSERT_TRUE(pushed.difference.has_value());
  EXPECT_EQ(pushed.ticks, 400u);
  EXPECT_EQ(pushed.difference->kind, "pose");
  EXPECT_TRUE(pushed.difference->field.starts_with("grid_from_tool.")) << pushed.difference->field;
  expect_difference(
      reaming_.verify(with_changed_tick(8, [](Tick& t) { t.world_from_handle.translation_nm[2] -= 200; })), 8,
      "pose", "grid_from_tool.z_nm");
  expect_difference(
      reaming_.verify(with_changed_tick(7, [](Tick& t) { t.world_from_handle.translation_nm[0] += 1; })), 7,
      "pose", "grid_from_tool.x_nm");
  const VerifyResult standing = reaming_.verify(with_changed_tick(350, [](Tick& t) { t.flags ^= 1; }));
  EXPECT_TRUE(standing.difference.has_value());
  EXPECT_EQ(standing.ticks, 350u);
  expect_difference(reaming_.verify(with_changed_tick(360, [](Tick& t) { t.flags |= record::stale_flag; })),
                    360, "bone", "session_hash");
}

TEST_F(Deceived, OnePoseOneVoxelOneForceThatWereNotSo) {
  expect_difference(
      reaming_.verify(with_changed_tick(401, [](Tick& t) { t.grid_from_tool.rotation_q30[4] ^= 1; })), 401,
      "pose", "grid_from_tool.rotation_q30[4]");
  expect_difference(reaming_.verify(with_changed_tick(402, [](Tick& t) { ++t.removed_cancellous; })), 402,
                    "bone", "removed_cancellous");
  expect_difference(reaming_.verify(with_changed_tick(403, [](Tick& t) { t.session_hash ^= 1; })), 403,
                    "bone", "session_hash");
  expect_difference(
      reaming_.verify(with_changed_tick(404, [](Tick& t) { t.thrust_n = std::nextafter(t.thrust_n, 0.0f); })),
      404, "force", "thrust_n");
  expect_difference(
      reaming_.verify(with_changed_tick(405, [](Tick& t) { t.hand_force_x_n = -t.hand_force_x_n; })), 405,
      "force", "hand_force_x_n");
}

TEST_F(Deceived, ABoneThatWasNotSo) {
  const auto path = changed<record::ops::Checkpoint>([](auto& c) { c.grid_hash ^= c.tick > 700 ? 1 : 0; });
  const record::Recording recording(path);
  const VerifyResult result = reaming_.verify(path);
  expect_difference(result, 749, "bone", "grid_hash");
  const Review review =
      review_recording(recording, recorded_case(recording, "", reaming_.data()), nullptr, UINT32_MAX);
  ASSERT_TRUE(review.difference.has_value());
  EXPECT_EQ(review.difference_tick, 749u);
  EXPECT_EQ(review.difference->field, "grid_hash");
}

TEST_F(Deceived, AnotherSeed) {
  const auto path = changed<record::ops::Header>([](auto& h) {
    json settings = json::parse(h.settings);
    settings["random_seed"] = 2;
    h.settings = settings.dump();
  });
  // Vibration is another one; nothing else knows the seed.
  const VerifyResult result = reaming_.verify(path);
  EXPECT_FALSE(result.difference.has_value());
  ASSERT_EQ(result.left_out.size(), 1u);
  EXPECT_NE(result.left_out[0].find("vibration"), std::string::npos);
  // One who also changed the tables is told in the first tick that vibrates.
  const auto twice = changed<record::ops::Header>([](auto& h) {
    json settings = json::parse(h.settings);
    settings["random_seed"] = 2;
    h.settings = settings.dump();
    const auto others = force::make_vibration_tracks({}, 2);
    json tables = json::parse(h.tables);
    tables["vibration"] = to_hex(others->hash());
    h.tables = tables.dump();
  });
  expect_difference(reaming_.verify(twice), 0, "vibration", "vibration_g");
}

TEST_F(Deceived, AnotherPhysicsIsSaidAndNotComputed) {
  const auto path = changed<record::ops::Header>([](auto& h) {
    json settings = json::parse(h.settings);
    EXPECT_EQ(settings.at("physics"), sim::physics_revision);
    settings["physics"] = sim::physics_revision + 1;
    h.settings = settings.dump();
  });
  test::expect_error(ErrorKind::conflict, "physics revision " + std::to_string(sim::physics_revision + 1),
                     [&] { reaming_.verify(path); });
  const record::Recording recording(path);
  const Review review =
      review_recording(recording, recorded_case(recording, "", reaming_.data()), nullptr, UINT32_MAX);
  EXPECT_FALSE(review.difference.has_value()) << "it can still be gone through";
}

TEST_F(Deceived, OtherSettingsOtherPlanOtherReamer) {
  const auto stiffer = changed<record::ops::Header>([](auto& h) {
    json settings = json::parse(h.settings);
    settings["stiffness_n_mm"] = settings["stiffness_n_mm"].get<double>() * 1.001;
    h.settings = settings.dump();
  });
  EXPECT_TRUE(reaming_.verify(stiffer).difference.has_value());
  const auto deeper = changed<record::ops::Header>([](auto& h) {
    json plan = json::parse(h.plan);
    plan["pilot_depth_mm"] = 4.0;
    h.plan = plan.dump();
  });
  expect_difference(reaming_.verify(deeper), 0, "bone", "start_grid_hash");
  const auto other = changed<record::ops::Segment>([](auto& s) { s.tool = "sphere 7,5 nipple 1.5,2"; });
  EXPECT_TRUE(reaming_.verify(other).difference.has_value());
}

TEST_F(Deceived, AnotherCase) {
  case_::Case c = case_::load_case(reaming_.data() / "cases/slab");
  c.bone.coverage[12345] ^= 1;
  case_::save_case(c, reaming_.data() / "cases/slab", true);
  test::expect_error(ErrorKind::conflict, "slab", [&] { reaming_.verify(path_); });
  std::filesystem::remove_all(reaming_.data() / "cases/slab");
  test::expect_error(ErrorKind::not_found, "slab", [&] { reaming_.verify(path_); });
}

TEST_F(Deceived, AnotherPlanOfTheCaseDoesNotMatter) {
  case_::Plan plan = RecordedReaming::small_plan();
  plan.entry_mm += Vec3(1.0, 0.0, 0.0);
  case_::save_plan(plan, reaming_.data() / "cases/slab");
  EXPECT_FALSE(reaming_.verify(path_).difference.has_value());
}

TEST(VerifyReplay, VibrationRecordingsThatAreGoneAreLeftOut) {
  RecordedReaming reaming;
  std::string csv = "g\n";
  for (int i = 0; i < 44100; ++i) csv += std::to_string(std::sin(0.3 * i) + std::sin(0.0371 * i * i)) + "\n";
  json script = RecordedReaming::push("sigma.7");
  script["vibration"] = {{"source", "recording"}, {"rate_hz", 22050.0}};
  for (const char* key : {"cortical_file", "cancellous_file"})
    script["vibration"][key] = reaming.folder().write(std::string(key) + ".csv", csv).string();
  const auto path = reaming.record(script);
  EXPECT_TRUE(reaming.verify(path).left_out.empty());
  EXPECT_FALSE(reaming.verify(path).difference.has_value());
  std::filesystem::remove(reaming.folder().path() / "cortical_file.csv");
  const VerifyResult result = reaming.verify(path);
  EXPECT_FALSE(result.difference.has_value());
  ASSERT_EQ(result.left_out.size(), 1u);
  EXPECT_NE(result.left_out[0].find("cortical_file.csv"), std::string::npos) << result.left_out[0];
}

}  // namespace
}  // namespace ream::session
