// Machines that sense force and move, with a simulated hand in them, through the haptic loop: how fast they
// feed, that they keep to their limits, and how they are shut down.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "device/admittance/admittance_device.hpp"
#include "device/registry/device_registry.hpp"
#include "device/simulated/admittance_plant.hpp"
#include "force/coefficients.hpp"
#include "sim/haptic_loop.hpp"
#include "support/small_run.hpp"
#include "support/wait_until.hpp"
#include "support/watched_machine.hpp"

namespace ream::test {
namespace {

struct PlantKind {
  const device::PlantParameters& plant;
  const char* profile;
};
const std::vector<PlantKind>& plants() {
  static const std::vector<PlantKind> both{{device::hapticmaster_plant(), "hapticmaster"},
                                           {device::robot_plant(), "robot-force-mode"}};
  return both;
}

constexpr double surface_mm = 9.0, density_g_cc = 0.5;
/// Eq. 5.1, cancellous, at 52 N (thesis 5.4).
constexpr double feed_at_52_n_mm_s = 0.42 - 0.34 * density_g_cc;

device::Script press_52_n(const std::string& profile, double force_scale, double duration_s) {
  device::Script script = steady_push(52.0, duration_s, force_scale);
  script.device_profile = profile;
  script.stiffness_n_mm = 0.0;
  script.hand.start_mm = Vec3(0, 0, -2.0);
  script.hand.force_profile = {{0.0, 0.0}, {2.0, 52.0}};
  script.hand.arm_damping_n_s_mm = 0.5;
  return script;
}

/// One machine, with everything from the hand to the bone.
struct Machine {
  Machine(const PlantKind& kind, const device::Script& script, const MachineFault& fault = {})
      : plant(kind.plant), run(bone(), slab_plan(bone(), surface_mm), "sphere 5,5", script) {
    auto machine = device::make_admittance_plant(kind.plant, device::device_profile(kind.profile), script, 1);
    const Pose start{Mat3::Identity(), script.hand.start_mm};
    run.device = std::make_unique<device::AdmittanceDevice>(
        std::make_unique<WatchedMachine>(std::move(machine), seen, fault), run.model.world_from_plan * start);
  }
  static voxel::BoneModel bone() { return slab({64, 64, 64}, 0.2, surface_mm, density_g_cc); }

  const device::PlantParameters& plant;
  std::shared_ptr<WatchedMachine::Seen> seen = std::make_shared<WatchedMachine::Seen>();
  SmallRun run;
};

std::vector<std::string> in_order() { return {"open", "enable", "rest", "disable", "close"}; }

TEST(AdmittanceLoop, FiftyTwoNewtonsFeedAsTheLawHasIt) {
  for (const PlantKind& kind : plants())
    for (const double force_scale : {1.0, 4.0}) {
      SCOPED_TRACE(std::string(kind.profile) + ", force scale " + std::to_string(force_scale));
      Machine machine(kind, press_52_n(kind.profile, force_scale, 12.0));
      SpscRing<record::TickReport> reports(1 << 14);
      sim::HapticLoop loop(machine.run.model, machine.run.state, *machine.run.device, reports,
                           {false, sim::Realtime::off});
      EXPECT_EQ(loop.run(), sim::LoopEnd::finished);
      std::vector<record::TickReport> all;
      for (record::TickReport report; reports.try_pop(report);) all.push_back(report);
      ASSERT_EQ(all.size(), 12'000u);
      // Steady: the cap is under way, and the machine has been told the same all along.
      const auto depth_mm = [&](const Pose& pose) {
        return (machine.run.model.world_from_plan.inverse() * pose).translation_mm.z();
      };
      const double told_mm_s = depth_mm(all[11'000].world_from_tool) - depth_mm(all[9'000].world_from_tool);
      double thrust_n = 0.0;
      for (size_t i = 9'000; i < 11'000; ++i) thrust_n += all[i].thrust_n / 2000.0;
      EXPECT_NEAR(thrust_n, 52.0, 0.02 * 52.0);
      EXPECT_NEAR(told_mm_s / 2.0, feed_at_52_n_mm_s, 0.02 * feed_at_52_n_mm_s);
      // And the machine itself has gone as fast.
      const auto& measured = machine.seen->measured;
      const double moved_mm = (measured[11'000].translation_mm - measured[9'000].translation_mm).norm();
      EXPECT_NEAR(moved_mm / 2.0, feed_at_52_n_mm_s, 0.02 * feed_at_52_n_mm_s);
      std::printf("%s x%g: thrust %.3f N, feed %.5f mm/s (law %.5f), fastest %.2f mm/s, %.0f mm/s^2\n",
                  kind.profile, force_scale, thrust_n, moved_mm / 2.0, feed_at_52_n_mm_s,
                  machine.seen->fastest_mm_s, machine.seen->hardest_mm_s2);
      expect_within_limits(*machine.seen, kind.plant.limits.motion);
      EXPECT_EQ(machine.seen->calls, in_order());
    }
}

TEST(AdmittanceLoop, FaultsWhilePressingEndOrGoOnInOrder) {
  using Kind = MachineFault::Kind;
  struct Row {
    const char* name;
    MachineFault fault;
    sim::LoopEnd end;
  };
  for (const PlantKind& kind : plants())
    for (const Row& row : {Row{"silent", {Kind::silent, 3000, 300}, sim::LoopEnd::finished},
                           Row{"NaN", {Kind::no_number, 3000, 300}, sim::LoopEnd::finished},
                           Row{"clipped", {Kind::clipped, 3000, 300}, sim::LoopEnd::finished},
                           Row{"lags", {Kind::lags, 3000}, sim::LoopEnd::device_fault},
                           Row{"collides", {Kind::collides, 3000}, sim::LoopEnd::device_fault},
                           Row{"killed", {Kind::unreadable, 3000}, sim::LoopEnd::device_fault},
                           Row{"deaf", {Kind::deaf, 3000}, sim::LoopEnd::device_fault}}) {
      SCOPED_TRACE(std::string(kind.profile) + ": " + row.name);
      Machine machine(kind, press_52_n(kind.profile, 1.0, 5.0), row.fault);
      SpscRing<record::TickReport> reports(1 << 13);
      sim::HapticLoop loop(machine.run.model, machine.run.state, *machine.run.device, reports,
                           {false, sim::Realtime::off});
      EXPECT_EQ(loop.run(), row.end);
      bool rested = false;
      double force_after_n = 0.0, thrust_at_end_n = 0.0;
      for (record::TickReport report; reports.try_pop(report);) {
        rested |= report.paused;
        if (report.paused) force_after_n = std::max(force_after_n, report.hand_force_n.norm());
        thrust_at_end_n = report.thrust_n;
      }
      EXPECT_EQ(rested, row.end == sim::LoopEnd::finished);
      EXPECT_EQ(force_after_n, 0.0);
      if (row.end == sim::LoopEnd::finished) {
        EXPECT_NEAR(thrust_at_end_n, 52.0, 2.0) << "it presses on";
      }
      expect_within_limits(*machine.seen, kind.plant.limits.motion);
      EXPECT_EQ(machine.seen->told_after_stop, 0);
      std::vector<std::string> calls = machine.seen->calls;
      std::erase(calls, "rest");
      EXPECT_EQ(calls, (std::vector<std::string>{"open", "enable", "disable", "close"}));
    }
}

/// In a program of its own, that SIGTERM ends while the machine presses: what it wrote down of its calls.
TEST(AdmittanceLoop, SigtermStopsThenDisablesThenCloses) {
  for (const PlantKind& kind : plants()) {
    SCOPED_TRACE(kind.profile);
    int pipe_ends[2];
    ASSERT_EQ(::pipe(pipe_ends), 0);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      catch_interrupts();
      Machine machine(kind, press_52_n(kind.profile, 1.0, 600.0));
      SpscRing<record::TickReport> reports(1 << 20);
      sim::HapticLoop loop(machine.run.model, machine.run.state, *machine.run.device, reports,
                           {true, sim::Realtime::off});
      loop.start();
      wait_until("it to press", [&] { return reports.size() > 500; });
      if (::write(pipe_ends[1], "!", 1) != 1) ::_exit(2);
      wait_until("the signal", [] { return interrupted(); });
      loop.stop();
      std::string calls;
      for (const std::string& call : machine.seen->calls) calls += call + " ";
      if (::write(pipe_ends[1], calls.data(), calls.size()) < 0) ::_exit(3);
      ::_exit(machine.seen->stops > 0 ? 0 : 1);
    }
    ::close(pipe_ends[1]);
    char byte = 0;
    ASSERT_EQ(::read(pipe_ends[0], &byte, 1), 1);
    ::kill(child, SIGTERM);
    std::string calls;
    while (::read(pipe_ends[0], &byte, 1) == 1) calls += byte;
    ::close(pipe_ends[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(calls, "open enable rest disable close ");
  }
}

/// The time by which a loop is watched: it goes on as the machine says, not as busy as this computer is.
std::atomic<int64_t> machine_ns{1};
std::atomic<int> asked{0};
int64_t machine_clock() {
  ++asked;
  return machine_ns;
}

/// A real machine, whose motors take a while to go off.
class SlowToLetGo final : public device::AdmittanceMachine {
 public:
  explicit SlowToLetGo(std::unique_ptr<device::AdmittanceMachine> machine)
      : machine_(std::move(machine)), traits_(machine_->traits()) {
    traits_.simulated = false;
  }
  const device::DeviceTraits& traits() const noexcept override { return traits_; }
  const device::MachineLimits& limits() const noexcept override { return machine_->limits(); }
  void open() override { machine_->open(); }
  void enable() override { machine_->enable(); }
  device::DeviceStatus sense(device::MachineSense& sense) noexcept override {
    machine_ns += tick_ns;
    return machine_->sense(sense);
  }
  bool move_to(const Pose& at) noexcept override { return machine_->move_to(at); }
  void session_paused(bool paused) noexcept override { machine_->session_paused(paused); }
  void stop() noexcept override { machine_->stop(); }
  void disable() noexcept override {
    machine_ns += 2 * std::chrono::nanoseconds(sim::LoopGuard::held_limit).count();
    // Until it has been looked at twice the guard has judged the new time.
    wait_until("the guard", [before = asked.load()] { return asked >= before + 2; });
    machine_->disable();
  }
  void close() noexcept override { machine_->close(); }

 private:
  const std::unique_ptr<device::AdmittanceMachine> machine_;
  device::DeviceTraits traits_;
};

TEST(AdmittanceLoop, AMachineThatIsClosedInOrderIsNotTakenForALoopThatStandsStill) {
  for (const PlantKind& kind : plants()) {
    SCOPED_TRACE(kind.profile);
    const device::Script script = press_52_n(kind.profile, 1.0, 600.0);
    Machine machine(kind, script);
    machine.run.device = std::make_unique<device::AdmittanceDevice>(
        std::make_unique<SlowToLetGo>(std::make_unique<WatchedMachine>(
            device::make_admittance_plant(kind.plant, device::device_profile(kind.profile), script, 1),
            machine.seen)),
        machine.run.model.world_from_plan);
    SpscRing<record::TickReport> reports(1 << 14);
    sim::HapticLoop loop(machine.run.model, machine.run.state, *machine.run.device, reports,
                         {true, sim::Realtime::off, -1, machine_clock});
    loop.start();
    wait_until("a hundred ticks", [&] { return reports.size() >= 100; });
    loop.request_stop();
    wait_until("the end", [&] { return loop.ended(); });
    EXPECT_EQ(loop.stood_still_ms(), 0);
    EXPECT_EQ(loop.health().end, sim::LoopEnd::stopped);
    EXPECT_EQ(machine.seen->stops, 1) << "its own, once it is at rest";
  }
}

TEST(AdmittanceLoop, PlantsAreDevicesThatPeopleCanChoose) {
  for (const PlantKind& kind : plants()) {
    device::Script script = press_52_n("ideal", 1.0, 1.0);
    device::settle_for_device(kind.plant.name, "", script);
    EXPECT_EQ(script.device_profile, kind.profile);
    const device::DeviceInfo offer = device::device_kind(kind.plant.name).offer({});
    EXPECT_TRUE(offer.usable);
    const device::MadeDevice made = device::make_device({kind.plant.name, "", &script, Pose{}, 1, {}});
    EXPECT_EQ(made.device->traits().causality, device::Causality::admittance);
    EXPECT_TRUE(made.device->traits().simulated);
    EXPECT_EQ(made.device->traits().force_max_n, offer.force_max_n);
    try {
      device::make_device({kind.plant.name, "touch", &script, Pose{}, 1, {}});
      FAIL() << "an impedance profile is no machine's";
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::invalid_input);
    }
  }
}

}  // namespace
}  // namespace ream::test
