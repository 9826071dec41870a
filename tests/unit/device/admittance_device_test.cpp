#include "device/admittance/admittance_device.hpp"

#include "device/profiles.hpp"
#include "device/simulated/admittance_plant.hpp"
#include "support/expect_error.hpp"
#include "support/random_pose.hpp"
#include "support/watched_machine.hpp"

namespace ream::device {
namespace {

using test::MachineFault;
using test::WatchedMachine;
using Kind = MachineFault::Kind;

struct PlantKind {
  const PlantParameters& plant;
  const char* profile;
};
const std::vector<PlantKind>& plants() {
  static const std::vector<PlantKind> both{{hapticmaster_plant(), "hapticmaster"},
                                           {robot_plant(), "robot-force-mode"}};
  return both;
}

Script pulling(double force_n, double arm_damping_n_s_mm = 1.0) {
  Script script;
  script.hand.arm_damping_n_s_mm = arm_damping_n_s_mm;
  script.duration_s = 10.0;
  script.hand.force_profile = {{0.0, force_n}};
  return script;
}

/// A device in the hand of a script, in free space: the mass that a session would simulate is simulated here.
struct Simulation {
  Simulation(const PlantKind& kind, double force_n, const MachineFault& fault = {},
             double arm_damping_n_s_mm = 1.0)
      : plant(kind.plant),
        device(
            std::make_unique<WatchedMachine>(make_admittance_plant(kind.plant, device_profile(kind.profile),
                                                                   pulling(force_n, arm_damping_n_s_mm), 1),
                                             seen, fault),
            world_from_start) {}

  /// False when the device has a fault.
  bool tick() {
    if (device.read(input) != DeviceStatus::ok) return false;
    if (input.paused) velocity_mm_s.setZero();
    const Vec3 force_n =
        input.age_ms < device.traits().stale.fade_ms ? input.hand_force_n : Vec3(Vec3::Zero());
    const double mass = device.traits().effective_mass_kg;
    if (!input.paused)
      velocity_mm_s =
          (velocity_mm_s + tick_s * 1000.0 / mass * force_n) / (1.0 + tick_s * 1000.0 / mass * 0.01);
    tool.translation_mm += tick_s * velocity_mm_s;
    DeviceOutput output;
    output.world_from_tool = tool;
    return device.write(output) == DeviceStatus::ok;
  }
  bool run(int ticks) {
    for (int i = 0; i < ticks; ++i)
      if (!tick()) return false;
    return true;
  }

  const PlantParameters& plant;
  const Pose world_from_start{rotation_from_small_vector({0.2, -0.1, 0.4}), Vec3(10.0, 20.0, 30.0)};
  std::shared_ptr<WatchedMachine::Seen> seen = std::make_shared<WatchedMachine::Seen>();
  AdmittanceDevice device;
  DeviceInput input;
  Pose tool = world_from_start;
  Vec3 velocity_mm_s = Vec3::Zero();
};

const std::vector<std::string> in_order{"open", "enable", "rest", "disable", "close"};

TEST(AdmittanceDevice, ZeroesItsSensorAndBeginsWhereTheToolIs) {
  for (const PlantKind& kind : plants()) {
    SCOPED_TRACE(kind.plant.name);
    Simulation simulation(kind, 0.0);
    simulation.device.open();
    ASSERT_EQ(simulation.device.read(simulation.input), DeviceStatus::ok);
    EXPECT_GT(kind.plant.sensor_bias_n.norm(), 3.0);
    EXPECT_LT(simulation.input.hand_force_n.norm(), 6.0 * kind.plant.sensor_noise_rms_n)
        << "the bias is taken away";
    EXPECT_LT((simulation.input.world_from_handle.translation_mm - simulation.world_from_start.translation_mm)
                  .norm(),
              1e-9);
    EXPECT_TRUE(
        simulation.input.world_from_handle.rotation.isApprox(simulation.world_from_start.rotation, 1e-12));
    simulation.device.close();
    EXPECT_EQ(simulation.seen->calls, in_order);
  }
}

TEST(AdmittanceDevice, AHandLeadsItFreelyWithoutRinging) {
  for (const PlantKind& kind : plants()) {
    SCOPED_TRACE(kind.plant.name);
    Simulation simulation(kind, 20.0);
    simulation.device.open();
    ASSERT_TRUE(simulation.run(3000));
    // 20 N on an arm that resists with 1 N s/mm and a mass with a hundredth of that.
    const Vec3 along = simulation.world_from_start.rotation.col(2);
    EXPECT_NEAR(simulation.velocity_mm_s.dot(along), 20.0 / 1.01, 1.0);
    const Vec3 sideways = simulation.velocity_mm_s - along * simulation.velocity_mm_s.dot(along);
    EXPECT_LT(sideways.norm(), 1.0);
    simulation.device.close();
    test::expect_within_limits(*simulation.seen, kind.plant.limits.motion);
    EXPECT_EQ(simulation.seen->calls, in_order);
  }
}

TEST(AdmittanceDevice, AHandThatPullsTooHardMeetsTheLimits) {
  for (const PlantKind& kind : plants()) {
    SCOPED_TRACE(kind.plant.name);
    Simulation simulation(kind, 0.7 * kind.plant.limits.sensor_range_n, {}, 0.02);
    simulation.device.open();
    ASSERT_TRUE(simulation.run(4000));
    EXPECT_GT(simulation.seen->fastest_mm_s, 0.5 * kind.plant.limits.motion.speed_max_mm_s);
    test::expect_within_limits(*simulation.seen, kind.plant.limits.motion);
    simulation.device.close();
    test::expect_within_limits(*simulation.seen, kind.plant.limits.motion);
  }
}

struct FaultRow {
  const char* name;
  MachineFault fault;
  bool ends;  ///< the session, as by a fault; else it goes on
};

/// From tick 1000 on, while the hand leads the machine through the air.
const std::vector<FaultRow>& faults() {
  static const std::vector<FaultRow> rows{{"silent for 5 ms", {Kind::silent, 1000, 5}, false},
                                          {"silent for 30 ms", {Kind::silent, 1000, 30}, false},
                                          {"silent for 500 ms", {Kind::silent, 1000, 500}, false},
                                          {"NaN for 500 ms", {Kind::no_number, 1000, 500}, false},
                                          {"one NaN", {Kind::no_number, 1000, 1}, false},
                                          {"clipped for 500 ms", {Kind::clipped, 1000, 500}, false},
                                          {"lags", {Kind::lags, 1000}, true},
                                          {"collides", {Kind::collides, 1000}, true},
                                          {"killed", {Kind::unreadable, 1000}, true},
                                          {"deaf", {Kind::deaf, 1000}, true}};
  return rows;
}

TEST(AdmittanceDevice, EveryFaultBringsItToRestInItsTime) {
  for (const PlantKind& kind : plants())
    for (const FaultRow& row : faults()) {
      SCOPED_TRACE(kind.plant.name + ": " + row.name);
      Simulation simulation(kind, 30.0, row.fault);
      simulation.device.open();
      const int64_t last_tick = std::min<int64_t>(row.fault.from + row.fault.ticks, 1600);
      const bool ran = simulation.run(static_cast<int>(last_tick));
      EXPECT_EQ(ran, !row.ends);
      const double stale_ms = simulation.device.traits().stale.fade_ms;
      const double rest_ms = stale_ms + 1e3 * kind.plant.limits.motion.stop_time_s() + 2.0;
      if (!row.ends && static_cast<double>(row.fault.ticks) > rest_ms) {
        EXPECT_LE(static_cast<double>(simulation.seen->last_motion - row.fault.from), rest_ms);
        EXPECT_TRUE(simulation.input.paused);
      }
      if (!row.ends) {
        ASSERT_TRUE(simulation.run(2000)) << "it goes on";
        EXPECT_FALSE(simulation.input.paused);
        EXPECT_GT(simulation.velocity_mm_s.norm(), 25.0);
      }
      const bool strays = row.fault.kind == Kind::lags || row.fault.kind == Kind::collides;
      if (strays) {
        EXPECT_EQ(simulation.seen->stops, 1) << "at once, by itself";
        EXPECT_EQ(simulation.device.write({}), DeviceStatus::fault);
      }
      simulation.device.close();
      EXPECT_EQ(simulation.seen->told_after_stop, 0);
      test::expect_within_limits(*simulation.seen, kind.plant.limits.motion);
      std::vector<std::string> calls = simulation.seen->calls;
      std::erase(calls, "rest");
      EXPECT_EQ(calls, (std::vector<std::string>{"open", "enable", "disable", "close"}));
      EXPECT_GE(simulation.seen->stops, 1) << "before its motors are off";
      if (row.fault.kind != Kind::deaf && !strays) {
        EXPECT_EQ(simulation.seen->calls, in_order);
      }
    }
}

TEST(AdmittanceDevice, ASensorThatCannotBeZeroedIsSaidAndLeavesMotorsOff) {
  /// Says one thing for ever.
  class Broken final : public AdmittanceMachine {
   public:
    explicit Broken(const Vec3& force_n, double sway_n) : force_n_(force_n), sway_n_(sway_n) {
      traits_.simulated = true;
    }
    const DeviceTraits& traits() const noexcept override { return traits_; }
    const MachineLimits& limits() const noexcept override { return hapticmaster_plant().limits; }
    void open() override {}
    void enable() override { ADD_FAILURE() << "motors are on"; }
    DeviceStatus sense(MachineSense& sense) noexcept override {
      sense.force_n = force_n_;
      sense.force_n.x() += sway_n_ * (++samples_ % 100);
      return DeviceStatus::ok;
    }
    bool move_to(const Pose&) noexcept override { return true; }
    void session_paused(bool) noexcept override {}
    void stop() noexcept override {}
    void disable() noexcept override { ++disabled; }
    void close() noexcept override { ++closed; }
    int disabled = 0, closed = 0;

   private:
    DeviceTraits traits_ = device_profile("hapticmaster");
    Vec3 force_n_;
    double sway_n_;
    int samples_ = 0;
  };
  const auto refused = [](const std::string& words, const Vec3& force_n, double sway_n) {
    auto machine = std::make_unique<Broken>(force_n, sway_n);
    const Broken& seen = *machine;
    AdmittanceDevice device(std::move(machine), Pose{});
    test::expect_error(ErrorKind::unavailable, words, [&] { device.open(); });
    EXPECT_EQ(seen.closed, 1);
  };
  refused("let go of the handle", Vec3(1, 2, 3), 0.1);
  refused("beyond its range", Vec3(1, 2, 260), 0.0);
  refused("silent", Vec3(1, std::nan(""), 3), 0.0);
}

/// Stands elsewhere as soon as its motors are on.
class Sagging final : public AdmittanceMachine {
 public:
  struct Seen {
    std::vector<Pose> told;
    std::string calls;
  };
  Sagging(double sag_mm, double force_n, Seen& seen) : sag_mm_(sag_mm), force_n_(force_n), seen_(seen) {
    traits_.simulated = true;
  }
  const DeviceTraits& traits() const noexcept override { return traits_; }
  const MachineLimits& limits() const noexcept override { return hapticmaster_plant().limits; }
  void open() override { seen_.calls += "open "; }
  void enable() override {
    enabled_ = true;
    seen_.calls += "enable ";
  }
  DeviceStatus sense(MachineSense& sense) noexcept override {
    sense.base_from_handle.translation_mm = Vec3(1, 2, enabled_ ? 3.0 - sag_mm_ : 3.0);
    sense.force_n = Vec3(0, 0, enabled_ ? force_n_ : 0.0);
    return DeviceStatus::ok;
  }
  bool move_to(const Pose& at) noexcept override {
    seen_.told.push_back(at);
    return true;
  }
  void session_paused(bool) noexcept override {}
  void stop() noexcept override { seen_.calls += "stop "; }
  void disable() noexcept override { seen_.calls += "disable "; }
  void close() noexcept override { seen_.calls += "close "; }

 private:
  DeviceTraits traits_ = device_profile("hapticmaster");
  const double sag_mm_, force_n_;
  Seen& seen_;
  bool enabled_ = false;
};

TEST(AdmittanceDevice, BeginsWhereItHoldsOnceItsMotorsAreOn) {
  Sagging::Seen seen;
  AdmittanceDevice device(std::make_unique<Sagging>(1.0, 0.0, seen), Pose{});
  device.open();
  DeviceInput input;
  ASSERT_EQ(device.read(input), DeviceStatus::ok);
  EXPECT_LT(input.world_from_handle.translation_mm.norm(), 1e-12);
  ASSERT_EQ(device.write({}), DeviceStatus::ok);
  ASSERT_EQ(seen.told.size(), 1u);
  EXPECT_LT((seen.told.front().translation_mm - Vec3(1, 2, 2)).norm(), 1e-12);
}

TEST(AdmittanceDevice, AMachineThatMovesOrFallsSilentWhenItsMotorsGoOnIsRefused) {
  const auto refused = [](const std::string& words, double sag_mm, double force_n) {
    Sagging::Seen seen;
    AdmittanceDevice device(std::make_unique<Sagging>(sag_mm, force_n, seen), Pose{});
    test::expect_error(ErrorKind::unavailable, words, [&] { device.open(); });
    EXPECT_TRUE(seen.told.empty());
    EXPECT_EQ(seen.calls, "open enable stop disable close ");
  };
  refused("moved when its motors went on", 3.0, 0.0);
  refused("since its motors are on", 0.0, 260.0);
  refused("since its motors are on", 0.0, std::nan(""));
}

TEST(AdmittanceDevice, SaysHowLongItsBrakingMayTake) {
  for (const PlantKind& kind : plants()) {
    Simulation simulation(kind, 0.0);
    EXPECT_GT(simulation.device.closing_ms(), 2e3 * kind.plant.limits.motion.stop_time_s() + 100.0);
  }
}

TEST(AdmittanceDevice, TakenAwayFromOutsideItStopsByItself) {
  for (const PlantKind& kind : plants()) {
    SCOPED_TRACE(kind.plant.name);
    Simulation simulation(kind, 30.0);
    simulation.device.open();
    ASSERT_TRUE(simulation.run(1000));
    simulation.device.take_force_away();
    const Vec3 before_mm = simulation.input.world_from_handle.translation_mm;
    simulation.run(100);
    const double brake_mm = 30.0 * 30.0 / (2.0 * kind.plant.own_stop_mm_s2) + 1.0;
    EXPECT_LT((simulation.input.world_from_handle.translation_mm - before_mm).norm(), brake_mm);
    simulation.device.close();
    EXPECT_EQ(simulation.seen->calls.back(), "close");
  }
}

TEST(AdmittanceDevice, APlantNeedsAHand) {
  Script script = pulling(10.0);
  script.kind = ScriptKind::remote;
  test::expect_error(ErrorKind::invalid_input, "held by a script's hand", [&] {
    make_admittance_plant(robot_plant(), device_profile("robot-force-mode"), script, 1);
  });
}

}  // namespace
}  // namespace ream::device
