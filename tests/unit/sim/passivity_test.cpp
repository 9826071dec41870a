#include <gtest/gtest.h>

#include <iostream>
#include <random>

#include "core/clock.hpp"
#include "device/profiles.hpp"
#include "sim/settings.hpp"
#include "support/full_tests.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"
#include "support/small_run.hpp"

namespace ream::test {
namespace {

constexpr uint32_t passivity_seed = 20260;
constexpr int ticks_a_hand = 300;
constexpr double passivity_surface_mm = 6.0;

/// How somebody holds the handle: a mass that a controller of its own kind moves. Every one keeps within the
/// acceleration of a real arm, 100 m/s^2 besides what the device does to half a kilogram or more.
class Hand {
 public:
  enum class Kind { soft, stiff, tremor, impact, chatter, count };

  Hand(std::mt19937& random, Kind kind, double force_max_n) : random_(random), kind_(kind) {
    mass_kg_ = kind == Kind::stiff ? between(2.0, 6.0) : between(0.5, 2.0);
    push_n_ = between(1.0, std::min({60.0, 80.0 * mass_kg_, 2.0 * force_max_n}));
    arm_damping_n_s_mm_ = kind == Kind::stiff ? between(0.05, 0.5) : between(0.0, 0.02);
    position_mm_ = {between(-1.0, 1.0), between(-1.0, 1.0), between(-3.0, -0.2)};
    if (kind == Kind::impact) velocity_mm_s_ = {0.0, 0.0, 1000.0};
    lean_n_ = random_vector(random_, 5.0);
    tremor_rad_s_ = 2.0 * pi * between(6.0, 14.0);
    withdraw_tick_ = static_cast<int>(between(100.0, 400.0));
  }

  /// Moves for a tick under what it feels (plan frame); z goes into the bone.
  void move(int tick, const Vec3& felt_n) {
    Vec3 will_n = lean_n_ + Vec3(0, 0, tick < withdraw_tick_ ? push_n_ : -push_n_);
    if (kind_ == Kind::tremor) will_n.z() += push_n_ * std::sin(tremor_rad_s_ * tick * tick_s);
    if (kind_ == Kind::chatter) will_n = chatter_n();
    // A person keeps to the place; far aside the bone would end.
    will_n -= 2.0 * Vec3(position_mm_.x(), position_mm_.y(), 0.0) +
              0.02 * Vec3(velocity_mm_s_.x(), velocity_mm_s_.y(), 0.0);
    const double max_n = 99.0 * mass_kg_;
    will_n = clamp_length(will_n, max_n);
    const double gain = tick_s * 1000.0 / mass_kg_;
    velocity_mm_s_ += gain * (will_n + felt_n);
    velocity_mm_s_ /= 1.0 + gain * arm_damping_n_s_mm_;
    velocity_mm_s_ = clamp_length(velocity_mm_s_, 1500.0);
    position_mm_ += tick_s * velocity_mm_s_;
    turn_speed_rad_s_ = clamp_length(
        Vec3(0.98 * turn_speed_rad_s_ - 0.02 * turn_rad_ / tick_s + random_vector(random_, 0.05)), 1.0);
    turn_rad_ = clamp_length(Vec3(turn_rad_ + tick_s * turn_speed_rad_s_), 0.3);
  }

  Pose plan_from_handle() const { return {rotation_from_small_vector(turn_rad_), position_mm_}; }

 private:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  /// Turns back where that pays best: in as far as it felt nothing, out while it is pushed.
  Vec3 chatter_n() {
    const double outwards = position_mm_.z() > 0.0 ? -1.0 : 1.0;
    return Vec3(0, 0, 98.0 * mass_kg_ * std::clamp(outwards + between(-0.7, 0.7), -1.0, 1.0));
  }

  std::mt19937& random_;
  Kind kind_;
  double mass_kg_ = 1.0, push_n_ = 0.0, arm_damping_n_s_mm_ = 0.0, tremor_rad_s_ = 0.0;
  int withdraw_tick_ = 0;
  Vec3 position_mm_ = Vec3::Zero(), velocity_mm_s_ = Vec3::Zero(), lean_n_ = Vec3::Zero();
  Vec3 turn_rad_ = Vec3::Zero(), turn_speed_rad_s_ = Vec3::Zero();
};

/// What the promises are held against, from outside: the energy account is kept here once more.
class Witness {
 public:
  explicit Witness(const force::DeviceLimits& limits) : limits_(limits) {}

  /// `contact`: the part of the hand's wrench that is bone, not motor.
  void see(const record::TickReport& r, const force::Wrench& contact) {
    if (seen_) {
      const Vec3 way_mm = r.world_from_handle.translation_mm - handle_.translation_mm;
      const Vec3 turn_rad = handle_.rotation * small_vector_from_rotation(handle_.rotation.transpose() *
                                                                          r.world_from_handle.rotation);
      energy_mj -= force_n_.dot(way_mm) + torque_n_mm_.dot(turn_rad);
    }
    ASSERT_TRUE(r.hand_force_n.allFinite() && r.hand_torque_n_mm.allFinite());
    ASSERT_GE(energy_mj, -1.0);
    ASSERT_LE(r.hand_force_n.norm(), limits_.force_max_n + 1e-9);
    ASSERT_LE(r.hand_torque_n_mm.norm(), limits_.torque_max_n_mm + 1e-9);
    ASSERT_LE(upward_step(force_n_, contact.force_n), limits_.force_slew_n + 1e-9);
    ASSERT_LE(upward_step(torque_n_mm_, contact.torque_n_mm), limits_.torque_slew_n_mm + 1e-9);
    // Along the reamer's own axis, as far as it has not turned since the force of the tick before.
    const Vec3 axis = r.world_from_tool.rotation.col(2);
    const double turned = seen_ ? (axis - axis_).norm() : 0.0;
    // A tenth of a millinewton may be left of a force that is slewed while the reamer turns.
    ASSERT_GE(-r.hand_force_n.dot(axis), -1e-4 - (1e-3 + 2.0 * turned) * r.hand_force_n.norm()) << "pulls";
    axis_ = axis;
    seen_ = true;
    handle_ = r.world_from_handle;
    force_n_ = contact.force_n;
    torque_n_mm_ = contact.torque_n_mm;
    pressed_ = pressed_ || r.hand_force_n.norm() > 0.5 * limits_.force_max_n;
  }

  double energy_mj = 0.0;
  bool pressed() const { return pressed_; }

 private:
  /// How far `after` is from anything that a mere weakening of `before` gives.
  static double upward_step(const Vec3& before, const Vec3& after) {
    const double squared = before.squaredNorm();
    const double kept = squared > 0.0 ? std::clamp(before.dot(after) / squared, 0.0, 1.0) : 0.0;
    return (after - kept * before).norm();
  }

  force::DeviceLimits limits_;
  bool seen_ = false, pressed_ = false;
  Pose handle_;
  Vec3 force_n_ = Vec3::Zero(), torque_n_mm_ = Vec3::Zero(), axis_ = Vec3::Zero();
};

struct Bench {
  explicit Bench(force::FeedKind feed_kind)
      : whole(slab({48, 48, 32}, 0.25, passivity_surface_mm, 0.6)),
        run(whole, slab_plan(whole, passivity_surface_mm), "sphere 6,4", settings_script(), "cpu",
            sim::RemovalLaw::profile, feed_kind) {
    if (feed_kind == force::FeedKind::edge) run.model.settings.spindle.emplace();
  }

  static device::Script settings_script() {
    device::Script script = steady_push(1.0, 1.0);
    return script;
  }

  void fit(const device::DeviceTraits& traits, double stiffness_n_mm, double force_scale) {
    sim::Settings& s = run.model.settings;
    s.force_scale = force_scale;
    sim::fit_to_device(traits, stiffness_n_mm, s);
    s.start_up_ramp_s = 0.0;  // it would only hide the rest
    run.model.coupling = {s.stiffness_n_mm, s.angular_stiffness_n_mm_rad, force_scale};
  }

  voxel::BoneModel whole;
  SmallRun run;
};

/// All that render force but the ideal one, which is no device.
std::vector<device::DeviceTraits> impedance_devices() {
  std::vector<device::DeviceTraits> devices;
  for (const std::string& name : device::device_profile_names()) {
    const device::DeviceTraits traits = device::device_profile(name);
    if (traits.causality == device::Causality::impedance && traits.energy_guarded) devices.push_back(traits);
  }
  return devices;
}

/// Stiff and soft, trembling, striking at 1 m/s, chattering; on every device up to its stiffest coupling, in
/// bone of any hardness, with the spindle on and off and pauses between.
void hold_by_many_hands(Bench& bench) {
  const int hands = tried_of(10000, 400);
  std::cout << "seed " << test::seed(passivity_seed) << '\n';
  const auto devices = impedance_devices();
  ASSERT_GE(devices.size(), 14u);
  int pressed = 0;
  uint64_t weakened = 0;
  double lowest_mj = 0.0;
  bool bored = false;  // below the block there would be bone behind the reamer
  for (int n = 0; n < hands; ++n) {
    std::mt19937 random(test::seed(passivity_seed) + static_cast<unsigned>(n));
    std::uniform_real_distribution<double> one(0.0, 1.0);
    const device::DeviceTraits& traits = devices[static_cast<size_t>(n) % devices.size()];
    const double share = n % 3 == 0 ? 1.0 : 0.2 + 0.8 * one(random);
    bench.fit(traits, traits.stiffness_max_n_mm * share, std::exp(3.3 * one(random)));
    if (n % 50 == 0 || bored) {
      bench.run.bone.coverage = bench.whole.coverage;
      std::fill(bench.run.bone.density.writable().begin(), bench.run.bone.density.writable().end(),
                voxel::density_code(0.3 + 1.6 * one(random)));
    }
    sim::State state(bench.run.model, bench.run.bone);
    Hand hand(random, static_cast<Hand::Kind>(random() % static_cast<unsigned>(Hand::Kind::count)),
              traits.force_max_n);
    const Pose& world_from_plan = bench.run.model.world_from_plan;
    Witness witness(bench.run.model.settings.limits);
    const bool spindle_on = one(random) < 0.7;
    const int pause_at = one(random) < 0.2 ? 150 : ticks_a_hand;
    for (int tick = 0; tick < ticks_a_hand; ++tick) {
      device::DeviceInput input;
      input.world_from_handle = world_from_plan * hand.plan_from_handle();
      input.spindle_on = spindle_on;
      input.paused = tick >= pause_at && tick < pause_at + 40;
      record::TickReport report;
      ASSERT_EQ(sim::step(bench.run.model, state, input, report), sim::StepStatus::ok);
      witness.see(report, state.output.contact);
      if (testing::Test::HasFatalFailure()) {
        std::cout << "hand " << n << " on " << traits.name << ", tick " << tick << '\n';
        return;
      }
      lowest_mj = std::min(lowest_mj, witness.energy_mj);
      bored = (world_from_plan.inverse() * report.world_from_tool).translation_mm.z() > 3.0;
      if (bored) break;
      hand.move(tick, world_from_plan.rotation.transpose() * report.hand_force_n);
    }
    pressed += witness.pressed() ? 1 : 0;
    weakened += state.output.energy.weakened_ticks();
  }
  std::cout << "lowest energy " << lowest_mj << " mJ; " << pressed << " of " << hands
            << " hands met more than half of their device's force; weakened in " << weakened << " of "
            << hands * ticks_a_hand << " ticks\n";
  EXPECT_GT(pressed, hands / 4) << "most hands hardly touched the bone";
}

TEST(Passivity, ManyHandsDrawNoEnergy) {
  Bench bench(force::FeedKind::empirical);
  hold_by_many_hands(bench);
}

/// The lips pull sideways, the drive has its own speed, and the reamer slips with its mass.
TEST(Passivity, ManyHandsOnADriveDrawNoEnergyFromTheBone) {
  Bench bench(force::FeedKind::edge);
  hold_by_many_hands(bench);
}

}  // namespace
}  // namespace ream::test
