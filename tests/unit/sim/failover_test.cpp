#include <gtest/gtest.h>

#include "collide/removal/removal_cl.hpp"
#include "sim/haptic_loop.hpp"
#include "support/small_run.hpp"
#include "support/watched_backend.hpp"

namespace ream::test {
namespace {

/// A reaming along given poses, so that the hand does the same whatever it feels.
device::Script plunge_by_poses() {
  device::Script script;
  script.kind = device::ScriptKind::poses;
  script.duration_s = 0.6;
  script.stiffness_n_mm = 100.0;
  script.poses = {{0.0, Vec3(0, 0, -0.5), Vec3::Zero()},
                  {0.1, Vec3(0, 0, 0.4), Vec3::Zero()},
                  {0.6, Vec3(0.2, 0, 1.6), Vec3(0.05, 0.02, 0.0)}};
  return script;
}

struct FailingRun {
  explicit FailingRun(sim::RemovalLaw removal = sim::RemovalLaw::profile)
      : run(make(removal)), reserve_cells(run.state.cells) {}
  static SmallRun make(sim::RemovalLaw removal) {
    voxel::BoneModel bone = slab({64, 64, 64}, 0.2, 9.0, 0.5);
    const case_::Plan plan = slab_plan(bone, 9.0);
    return SmallRun(std::move(bone), plan, "sphere 8,4", plunge_by_poses(), "cpu", removal);
  }
  void give_reserve() { run.state.reserve = sim::make_cpp_backend(run.model, run.bone, reserve_cells); }
  void fail_contact_after(int calls, bool when_told = false) {
    auto& part = run.state.backend.narrow_phase;
    part = std::make_unique<FailingNarrowPhase>(std::move(part), calls, when_told);
  }
  void fail_removal_after(int calls) {
    auto& part = run.state.backend.removal;
    part = collide::guarded(std::make_unique<FailingRemoval>(std::move(part), calls), run.bone);
  }

  SmallRun run;
  const voxel::SolidCells& reserve_cells;
};

/// The run without a failure, for comparison.
struct Undisturbed {
  Undisturbed() : reports(run.run.run()) {}
  FailingRun run;
  std::vector<record::TickReport> reports;
};

void expect_as_undisturbed(FailingRun& failing, uint32_t* failed_tick = nullptr) {
  static Undisturbed undisturbed;
  const auto reports = failing.run.run();
  ASSERT_EQ(reports.size(), undisturbed.reports.size());
  int failovers = 0;
  for (size_t i = 0; i < reports.size(); ++i) {
    ASSERT_EQ(reports[i].session_hash, undisturbed.reports[i].session_hash) << "tick " << i;
    failovers += reports[i].failed_over;
    if (reports[i].failed_over) {
      EXPECT_EQ(reports[i].hand_force_n.norm(), 0.0);
      EXPECT_EQ(reports[i].hand_torque_n_mm.norm(), 0.0);
      EXPECT_EQ(reports[i].tick, failing.run.state.failed_over_tick);
      if (failed_tick != nullptr) *failed_tick = reports[i].tick;
    } else {
      EXPECT_EQ(reports[i].hand_force_n, undisturbed.reports[i].hand_force_n) << "tick " << i;
    }
  }
  EXPECT_EQ(failovers, 1);
  EXPECT_EQ(failing.run.bone.coverage, undisturbed.run.run.bone.coverage);
}

TEST(Failover, ADeviceThatFailsInContactCostsOneTickOfForceAndNothingElse) {
  for (const int calls : {0, 1, 40, 150}) {
    SCOPED_TRACE(calls);
    FailingRun failing;
    failing.give_reserve();
    failing.fail_contact_after(calls);
    expect_as_undisturbed(failing);
  }
}

TEST(Failover, ADeviceThatFailsHalfWayThroughACutLeavesNoTrace) {
  for (const int calls : {0, 1, 7, 200}) {
    SCOPED_TRACE(calls);
    FailingRun failing;
    failing.give_reserve();
    failing.fail_removal_after(calls);
    uint32_t tick = 0;
    expect_as_undisturbed(failing, &tick);
    EXPECT_GT(tick, 20u);
  }
}

TEST(Failover, ADeviceThatFailsWhenItIsToldOfChangesIsReplacedToo) {
  FailingRun failing;
  failing.give_reserve();
  failing.fail_contact_after(30, true);
  expect_as_undisturbed(failing);
}

TEST(Failover, TheLoopGoesOnAndSaysSo) {
  FailingRun failing;
  failing.give_reserve();
  failing.fail_removal_after(20);
  SpscRing<record::TickReport> reports(1024);
  sim::HapticLoop loop(failing.run.model, failing.run.state, *failing.run.device, reports,
                       {false, sim::Realtime::off});
  EXPECT_EQ(loop.run(), sim::LoopEnd::finished);
  EXPECT_EQ(reports.size(), 600u);
  EXPECT_GT(loop.health().failed_over_tick, 20);
  EXPECT_NE(sim::failover_message(7).find("tick 7"), std::string::npos);
}

TEST(Failover, WithoutAReserveOrAfterASecondFailureTheSessionEndsWithItsData) {
  for (const bool with_reserve : {false, true}) {
    FailingRun failing;
    if (with_reserve) {
      failing.give_reserve();
      auto& part = failing.run.state.reserve.narrow_phase;
      part = std::make_unique<FailingNarrowPhase>(std::move(part), 100);
    }
    failing.fail_contact_after(50);
    SpscRing<record::TickReport> reports(1024);
    sim::HapticLoop loop(failing.run.model, failing.run.state, *failing.run.device, reports,
                         {false, sim::Realtime::off});
    EXPECT_EQ(loop.run(), sim::LoopEnd::collision_failed);
    EXPECT_GT(reports.size(), with_reserve ? 100u : 20u) << "what was done before stays";
    EXPECT_LT(reports.size(), 600u);
    EXPECT_FALSE(message_of(sim::LoopEnd::collision_failed).empty());
  }
}

TEST(Failover, OpenClAndThenCppGiveTheResultOfEither) {
  for (const sim::RemovalLaw removal : {sim::RemovalLaw::profile, sim::RemovalLaw::decay}) {
    SCOPED_TRACE(sim::to_text(removal));
    FailingRun cpp(removal);
    const auto expected = cpp.run.run();
    voxel::BoneModel bone = slab({64, 64, 64}, 0.2, 9.0, 0.5);
    const case_::Plan plan = slab_plan(bone, 9.0);
    SmallRun mixed(std::move(bone), plan, "sphere 8,4", plunge_by_poses(), "opencl", removal);
    auto& part = mixed.state.backend.narrow_phase;
    part = std::make_unique<FailingNarrowPhase>(std::move(part), 300);
    const auto reports = mixed.run();
    ASSERT_EQ(reports.size(), expected.size());
    EXPECT_GE(mixed.state.failed_over_tick, 0);
    EXPECT_EQ(reports.back().session_hash, expected.back().session_hash);
    EXPECT_EQ(mixed.bone.coverage, cpp.run.bone.coverage);
  }
}

}  // namespace
}  // namespace ream::test
