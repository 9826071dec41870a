#include <gtest/gtest.h>

#include <map>

#include "support/small_run.hpp"
#include "support/watched_backend.hpp"

namespace ream::test {
namespace {

using Reports = std::vector<record::TickReport>;

device::Script push_by(const std::string& profile) {
  device::Script script = steady_push(40.0, 1.2, 4.0);
  script.device_profile = profile;
  script.stiffness_n_mm = 0.0;
  script.buttons = {{0.0, true, false}, {0.5, true, true}, {0.6, true, false}, {0.9, false, false}};
  return script;
}

struct Bench {
  explicit Bench(const device::Script& script) : Bench(script, slab({64, 64, 64}, 0.2, 9.0, 0.5)) {}
  Bench(const device::Script& script, voxel::BoneModel bone)
      : run(bone, slab_plan(bone, 9.0), "sphere 8,5", script, settings(script)) {}
  static sim::Settings settings(const device::Script& script) {
    sim::Settings s = SmallRun::settings(script, "cpu");
    sim::fit_to_device(device::device_profile(script.device_profile), script.stiffness_n_mm, s);
    return s;
  }
  SmallRun run;
};

/// Only what a recording keeps of the cause.
record::TickReport repeated(SmallRun& run, const record::TickReport& recorded) {
  device::DeviceInput input;
  input.world_from_handle = dequantised(recorded.world_from_handle_q);
  input.spindle_on = recorded.spindle_on;
  input.paused = recorded.paused;
  record::TickReport report;
  EXPECT_EQ(sim::step(run.model, run.state, input, report), sim::StepStatus::ok);
  return report;
}

void expect_same(const record::TickReport& found, const record::TickReport& wanted) {
  ASSERT_EQ(found.tick, wanted.tick);
  ASSERT_EQ(found.world_from_handle_q, wanted.world_from_handle_q) << "tick " << wanted.tick;
  ASSERT_EQ(found.grid_from_tool, wanted.grid_from_tool) << "tick " << wanted.tick;
  ASSERT_EQ(found.session_hash, wanted.session_hash) << "tick " << wanted.tick;
  ASSERT_EQ(found.hand_force_n, wanted.hand_force_n) << "tick " << wanted.tick;
  ASSERT_EQ(found.hand_torque_n_mm, wanted.hand_torque_n_mm) << "tick " << wanted.tick;
  ASSERT_EQ(found.thrust_n, wanted.thrust_n) << "tick " << wanted.tick;
}

void expect_repeats(SmallRun& again, const Reports& recorded) {
  again.state.handle_given = true;
  for (const record::TickReport& r : recorded) {
    expect_same(repeated(again, r), r);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Segment, RecordedPosesAreTheCauseOnEveryDevice) {
  for (const std::string& profile : device::device_profile_names()) {
    SCOPED_TRACE(profile);
    const device::Script script = push_by(profile);
    Bench live(script), again(script);
    const Reports reports = live.run.run();
    ASSERT_EQ(reports.size(), 1200u);
    EXPECT_GT(std::count_if(reports.begin(), reports.end(), [](auto& r) { return r.engaged; }), 100);
    expect_repeats(again.run, reports);
    EXPECT_EQ(again.run.bone.coverage, live.run.bone.coverage);
  }
}

TEST(Segment, AnAdmittanceDevicesRecordedPoseIsNotItsFirstOneAgain) {
  const device::Script script = push_by("ideal-admittance");
  Bench live(script), flying(script);
  const Reports reports = live.run.run();
  // Without being told that poses are given, the mass would stay where it is: nobody pushes it.
  const auto last = [&] {
    for (size_t i = 0; i + 1 < reports.size(); ++i) repeated(flying.run, reports[i]);
    return repeated(flying.run, reports.back());
  }();
  EXPECT_NE(last.session_hash, reports.back().session_hash);
}

TEST(Segment, AFailureOfTheDeviceIsRepeatedByTheFormThatCannotFail) {
  const device::Script script = push_by("omega.6");
  Bench live(script), again(script);
  sim::State& state = live.run.state;
  state.reserve = sim::make_cpp_backend(live.run.model, live.run.bone, state.cells);
  state.backend.narrow_phase =
      std::make_unique<FailingNarrowPhase>(std::move(state.backend.narrow_phase), 300);
  const Reports reports = live.run.run();
  ASSERT_GT(state.failed_over_tick, 0);
  again.run.state.failed_over_tick = state.failed_over_tick;
  expect_repeats(again.run, reports);
}

TEST(Segment, CarriesTickAndHashOnAndBeginsEverythingElse) {
  const device::Script script = push_by("ideal");
  Bench first(script);
  const Reports reports = first.run.run();
  const uint64_t hash = reports.back().session_hash;
  const auto second_from = [&](const sim::ResumeState& from) {
    voxel::BoneModel bone = first.run.bone;
    const case_::Plan plan = first.run.model.plan;
    const sim::Model model =
        sim::make_model(plan, bone, shell::make_tool("sphere 6,4"), first.run.model.settings);
    sim::State state(model, bone, from);
    state.handle_given = true;
    std::vector<uint64_t> hashes;
    uint32_t tick = from.tick;
    for (const record::TickReport& cause : reports) {
      device::DeviceInput input;
      input.world_from_handle = dequantised(cause.world_from_handle_q);
      input.spindle_on = cause.spindle_on;
      record::TickReport report;
      EXPECT_EQ(sim::step(model, state, input, report), sim::StepStatus::ok);
      EXPECT_EQ(report.tick, tick++);
      hashes.push_back(report.session_hash);
    }
    return std::pair{hashes, bone.coverage};
  };
  const sim::ResumeState from{first.run.state.tick, first.run.state.session_hash};
  EXPECT_EQ(from.tick, 1200u);
  EXPECT_EQ(from.session_hash, hash);
  const auto [hashes, coverage] = second_from(from);
  const auto [again, coverage_again] = second_from(from);
  EXPECT_EQ(hashes, again);
  EXPECT_EQ(coverage, coverage_again);
  EXPECT_NE(second_from({from.tick, from.session_hash + 1}).first, hashes);
  EXPECT_NE(second_from({from.tick + 1, from.session_hash}).first.back(), hashes.back());
}

}  // namespace
}  // namespace ream::test
