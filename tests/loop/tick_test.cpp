#include <gtest/gtest.h>

#include <iostream>
#include <thread>

#include "collide/removal/removal_cl.hpp"
#include "loop/trapping_device.hpp"
#include "sim/haptic_loop.hpp"
#include "support/small_run.hpp"
#include "support/watched_backend.hpp"

namespace ream::test {
namespace {

constexpr double surface_mm = 12.0;
constexpr int rest_ticks[] = {500, 540};

/// Press, rest, lean over, let the spindle stand: a second of everything a hand does.
device::Script busy_hand(const std::string& profile = "ideal") {
  device::Script script;
  script.duration_s = 1.2;
  script.device_profile = profile;
  script.stiffness_n_mm = profile == "ideal" ? 100.0 : 0.0;
  script.hand.start_mm = Vec3(0.1, 0, -0.6);
  script.hand.tilt_rad = Vec3(0.02, -0.03, 0.0);
  script.hand.force_profile = {{0.0, 45.0}, {0.7, 60.0}, {0.8, -10.0}, {0.9, 45.0}};
  script.hand.tremor_rms_n = 2.0;
  script.hand.wrist = device::Wrist{};
  script.buttons = {{0.0, true, false}, {0.3, true, true}, {0.35, true, false}, {1.1, false, false}};
  return script;
}

struct Case {
  const char* name;
  device::Script script = busy_hand();
  sim::RemovalLaw removal = sim::RemovalLaw::profile;
  force::FeedKind feed = force::FeedKind::empirical;
  case_::GuideKind guide = case_::GuideKind::none;
  bool mounted = false, vibrating = false;
  size_t brick_ring = 8192;  ///< images; nobody takes any out of a small one
  bool wall_clock = false;
  std::string backend = "cpu";
};

SmallRun run_of(const Case& c) {
  voxel::BoneModel bone = slab({96, 96, 96}, 0.15, surface_mm, 0.6);
  case_::Plan plan = slab_plan(bone, surface_mm);
  if (c.guide != case_::GuideKind::none) {
    plan.pilot_hole = case_::PilotHole{3.2, 8.0};
    plan.guide = c.guide;
  }
  sim::Settings settings = SmallRun::settings(c.script, c.backend, c.removal, c.feed);
  if (c.mounted) settings.mount = device::chest_wall_mount;
  if (c.vibrating) settings.vibration.source = force::VibrationSource::synthesized;
  const char* tool = c.guide == case_::GuideKind::none ? "sphere 8,5" : "sphere 8,5 nipple 1.5,4";
  return SmallRun(std::move(bone), plan, tool, c.script, settings);
}

struct Watched {
  Caught caught;
  sim::LoopEnd end = sim::LoopEnd::running;
  int64_t failed_over_tick = -1;
  size_t ticks = 0, engaged = 0, cutting = 0, paused = 0, images = 0, images_waiting = 0;
  double largest_force_n = 0.0;
};

/// Runs it on a thread of its own with every trap armed; `fail` may spoil the backend beforehand.
Watched watch(const Case& c, const std::function<void(SmallRun&)>& fail = nullptr,
              const std::function<void(int, device::DeviceInput&)>& during_read = nullptr) {
  SmallRun run = run_of(c);
  if (fail) fail(run);
  Traps::prepare();  // by now the libraries are there
  voxel::BrickRing bricks(c.brick_ring);
  voxel::BrickSender sender(run.bone.grid, bricks);
  run.state.brick_sender = &sender;
  SpscRing<record::TickReport> reports(4096);
  TrappingDevice device(*run.device);
  device.during_read = [&](device::DeviceInput& input) {
    if (device.tick >= rest_ticks[0] && device.tick < rest_ticks[1]) {
      input.clutch = device.tick % 2 == 0;
      input.age_ms = device.tick - rest_ticks[0];
    }
    if (during_read) during_read(device.tick, input);
  };
  sim::HapticLoop loop(run.model, run.state, device, reports, {c.wall_clock, sim::Realtime::off});
  Watched seen;
  std::thread([&] { seen.end = loop.run(); }).join();
  seen.caught = Traps::caught();
  seen.failed_over_tick = run.state.failed_over_tick;
  seen.images = bricks.size();
  seen.images_waiting = sender.pending();
  seen.largest_force_n = device.largest_force_n;
  record::TickReport report;
  for (; reports.try_pop(report); ++seen.ticks) {
    seen.engaged += report.engaged;
    seen.cutting += report.cutting;
    seen.paused += report.paused;
  }
  return seen;
}

void expect_a_clean_reaming(const Case& c, const Watched& seen) {
  EXPECT_EQ(seen.end, sim::LoopEnd::finished);
  EXPECT_EQ(seen.ticks, 1200u);
  EXPECT_GT(seen.engaged, 300u);
  EXPECT_GT(seen.cutting, 50u);
  EXPECT_GE(seen.paused, 50u);
  EXPECT_GT(seen.images, 0u);
  EXPECT_GT(seen.largest_force_n, 1.0);
  EXPECT_EQ(seen.caught.of_ours(), 0u) << seen.caught.words();
  if (c.backend == "cpu") {
    EXPECT_EQ(seen.caught.words(), "");
  }
}

class Tick : public testing::TestWithParam<Case> {};

TEST_P(Tick, NeitherAllocatesNorLocksNorCallsTheSystem) {
  const Case& c = GetParam();
  const Watched seen = watch(c);
  expect_a_clean_reaming(c, seen);
  if (c.brick_ring < 100) {
    EXPECT_GT(seen.images_waiting, 0u) << "the ring was to be full";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Everything, Tick,
    testing::Values(Case{.name = "Plain"}, Case{.name = "OnTheClock", .wall_clock = true},
                    Case{.name = "FullBrickRing", .brick_ring = 4},
                    Case{.name = "Decay", .removal = sim::RemovalLaw::decay},
                    Case{.name = "Oblique", .feed = force::FeedKind::oblique},
                    Case{.name = "NippleInItsHole", .guide = case_::GuideKind::nipple},
                    Case{.name = "Pin", .guide = case_::GuideKind::pin},
                    Case{.name = "BoneThatGives", .mounted = true},
                    Case{.name = "Vibrating", .vibrating = true},
                    Case{.name = "SoftDevice", .script = busy_hand("touch"), .vibrating = true},
                    Case{.name = "AdmittanceDevice", .script = busy_hand("ideal-admittance")}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(TickTraps, WhatADeviceDoesInItsReadIsCaught) {
  const Case c{.name = "Careless"};
  int* kept = nullptr;
  const Watched seen = watch(c, nullptr, [&kept](int tick, device::DeviceInput&) {
    if (tick == 700) kept = new int(tick);
  });
  EXPECT_EQ(seen.caught.ours[static_cast<size_t>(Trap::allocate)], 1u) << seen.caught.words();
  EXPECT_EQ(seen.ticks, 1200u) << "what is caught is done all the same";
  delete kept;
}

TEST(TickTraps, TakingOverFromAFailedDeviceNeitherAllocatesNorLocks) {
  const Case c{.name = "Failover"};
  std::optional<voxel::SolidCells> cells;
  for (const bool in_contact : {true, false}) {
    SCOPED_TRACE(in_contact);
    const Watched seen = watch(c, [&](SmallRun& run) {
      run.state.reserve = sim::make_cpp_backend(run.model, run.bone, run.state.cells);
      auto& backend = run.state.backend;
      if (in_contact)
        backend.narrow_phase = std::make_unique<FailingNarrowPhase>(std::move(backend.narrow_phase), 100);
      else
        backend.removal =
            collide::guarded(std::make_unique<FailingRemoval>(std::move(backend.removal), 50), run.bone);
    });
    EXPECT_GT(seen.failed_over_tick, 0);
    expect_a_clean_reaming(c, seen);
  }
}

/// The vendor's library is no code of ours; its calls are counted for people to read.
TEST(TickTraps, WithOpenClOnlyTheVendorsLibraryDoesAnyOfIt) {
  const Case c{.name = "OpenCl", .backend = "opencl"};
  const Watched seen = watch(c);
  expect_a_clean_reaming(c, seen);
  std::cout << "in " << seen.ticks << " ticks of which " << seen.engaged << " in contact:\n"
            << seen.caught.words();
}

}  // namespace
}  // namespace ream::test
