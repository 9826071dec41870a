#include "force/guide.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/expect_error.hpp"
#include "support/seed.hpp"

namespace ream::force {
namespace {

constexpr double clearance_mm = 0.1;

Guide nipple() { return nipple_guide(3.0, 8.0, 6.2, 12.0); }

Pose upright(double x_mm, double y_mm, double z_mm) { return {Mat3::Identity(), Vec3(x_mm, y_mm, z_mm)}; }

/// Tilted about the origin of the tool by rotation vector (x, y, 0).
Pose tilted(const Vec3& place_mm, double about_x_rad, double about_y_rad) {
  return {rotation_from_small_vector(Vec3(about_x_rad, about_y_rad, 0.0)), place_mm};
}

/// Put in along the axis so that the tool's origin is at `z_mm`.
GuideState put_in(const Guide& guide, double z_mm) {
  GuideState state;
  follow(guide, state, upright(0, 0, guide.mouth_mm - guide.leading_mm - 1.0));
  follow(guide, state, upright(0, 0, guide.mouth_mm - guide.leading_mm + 0.5));
  EXPECT_TRUE(state.entered);
  follow(guide, state, upright(0, 0, z_mm));
  constrained(guide, state, upright(0, 0, z_mm));
  return state;
}

double sideways(const Pose& pose, double tool_z_mm) {
  const Vec3 p = pose.point(Vec3(0, 0, tool_z_mm));
  return std::sqrt(p.x() * p.x() + p.y() * p.y());
}

TEST(Guide, SidewaysItStopsAtTheClearance) {
  GuideState state = put_in(nipple(), 2.0);
  const Pose inside = upright(0.06, 0.05, 2.0);
  const Pose kept = constrained(nipple(), state, inside);
  EXPECT_EQ(kept.translation_mm, inside.translation_mm);
  EXPECT_EQ(kept.rotation, inside.rotation);

  // In the middle of the guided length, force and place are those of a plain wall: K (offset - clearance).
  Guide middle = nipple();
  middle.leading_mm = 4.0;
  state = put_in(middle, 7.0);
  const Pose stopped = constrained(middle, state, upright(0.9, 1.2, 7.0));
  EXPECT_NEAR(sideways(stopped, 0.0), clearance_mm, 1e-6);
  EXPECT_NEAR((upright(0.9, 1.2, 7.0).translation_mm - stopped.translation_mm).norm(), 1.5 - clearance_mm,
              1e-6);
  EXPECT_NEAR(stopped.translation_mm.z(), 7.0, 1e-12);
}

TEST(Guide, TiltIsLimitedByTheInsertedLength) {
  for (const double z : {-5.0, -3.0, 2.0}) {
    const Guide guide = nipple();
    GuideState state = put_in(guide, z);
    Pose kept;
    // Slowly, as a hand does it.
    for (int i = 0; i <= 300; ++i) kept = constrained(guide, state, tilted(Vec3(0, 0, z), 0.001 * i, 0.0));
    const double inserted = std::min(8.0, kept.translation_mm.z() + 8.0);
    const Vec3 axis = kept.rotation.col(2);
    EXPECT_LE(std::abs(axis.y()), 2.0 * clearance_mm / inserted + 1e-6) << z;
    EXPECT_GT(std::abs(axis.y()), 0.9 * 2.0 * clearance_mm / inserted) << z;
    EXPECT_LE(kept.translation_mm.z(), z + 1e-9);
  }
}

TEST(Guide, AHoleDrilledTooShallowBlocks) {
  const Guide guide = nipple_guide(3.0, 8.0, 6.2, 5.0);
  GuideState state = put_in(guide, -4.0);
  EXPECT_NEAR(constrained(guide, state, upright(0, 0, 3.0)).translation_mm.z(), -3.0, 1e-12);
  EXPECT_NEAR(held(guide, state, upright(0, 0, -2.5)).translation_mm.z(), -3.0, 1e-12);
}

TEST(Guide, MissingTheMouthLeavesTheToolAlone) {
  const Guide guide = nipple();
  GuideState state;
  follow(guide, state, upright(1.0, 0, -9.0));
  follow(guide, state, upright(1.0, 0, -6.0));
  EXPECT_FALSE(state.entered);
  follow(guide, state, upright(0.0, 0, -6.0));  // sliding in from the side, deep in the bone
  EXPECT_FALSE(state.entered);
  const Pose far = upright(3.0, 0, -6.0);
  EXPECT_EQ(constrained(guide, state, far).translation_mm, far.translation_mm);
  follow(guide, state, upright(0.0, 0, -8.5));
  follow(guide, state, upright(0.05, 0, -7.5));
  EXPECT_TRUE(state.entered);
  follow(guide, state, upright(0.05, 0, -8.1));
  EXPECT_FALSE(state.entered);
}

TEST(Guide, ANippleTooThickIsRefused) {
  test::expect_error(ErrorKind::conflict, "does not fit", [] { nipple_guide(3.1, 8.0, 6.2, 12.0); });
}

TEST(Guide, PinHoldsTheBoreOverItsLength) {
  const Guide guide = pin_guide();
  GuideState state;
  follow(guide, state, upright(1.0, 0, -12.0));  // begins on the pin, whatever the hand does
  ASSERT_TRUE(state.entered);
  constrained(guide, state, upright(0, 0, -12.0));
  const Pose kept = constrained(guide, state, tilted(Vec3(2.0, -1.0, -12.0), 0.1, -0.05));
  EXPECT_NEAR(std::max(sideways(kept, 0.0), sideways(kept, -30.0)), pin_clearance_mm, 1e-6);
  EXPECT_NEAR(kept.translation_mm.z(), -12.0, 1e-9);
  EXPECT_NEAR(constrained(guide, state, upright(0, 0, 30.0)).translation_mm.z(), 30.0, 1e-9);
  // Once it has been drawn off it must be put on again.
  follow(guide, state, upright(0, 0, -81.0));
  follow(guide, state, upright(1.0, 0, -79.0));
  EXPECT_FALSE(state.entered);
}

/// A handle that wanders in and about the guide, a little each tick.
class Wandering {
 public:
  explicit Wandering(unsigned seed) : random_(seed) {}
  Pose next(double deepest_mm) {
    std::normal_distribution<double> one(0.0, 1.0);
    for (int i = 0; i < 5; ++i) at_[i] = 0.995 * at_[i] + scale_[i] * one(random_);
    const double z = -3.0 + at_[2];
    return tilted(Vec3(at_[0], at_[1], std::min(z, deepest_mm)), at_[3], at_[4]);
  }

 private:
  std::mt19937 random_;
  std::array<double, 5> at_{}, scale_{0.05, 0.05, 0.1, 0.003, 0.003};
};

TEST(Guide, WanderingHandlesStayBetweenTheWallsAndAreNeverPulledIn) {
  for (uint32_t n = 0; n < 20; ++n) {
    const uint32_t seed = test::seed() + n;
    const Guide guide = nipple();
    GuideState state = put_in(guide, -4.0);
    Wandering hand(seed);
    for (int i = 0; i < 3000; ++i) {
      const Pose handle = hand.next(100.0);
      const Pose kept = constrained(guide, state, handle);
      ASSERT_TRUE(kept.rotation.allFinite() && kept.translation_mm.allFinite()) << "seed " << seed;
      EXPECT_LE(kept.translation_mm.z(), handle.translation_mm.z() + 1e-12) << "seed " << seed;
      const double depth = kept.translation_mm.z() + 8.0;
      if (handle.translation_mm.z() > -8.0) {
        EXPECT_LE(sideways(kept, 8.0), clearance_mm + 1e-6) << "seed " << seed << " tick " << i;
        EXPECT_LE(sideways(kept, 8.0 - std::min(0.88 * depth, 7.9)), clearance_mm + 1e-6)
            << "seed " << seed << " tick " << i;
        const Pose again = held(guide, state, kept);
        EXPECT_LE((again.translation_mm - kept.translation_mm).norm(), 1e-6);
        EXPECT_LE((again.rotation - kept.rotation).norm(), 1e-6);
      }
    }
  }
}

/// Work of the hand against the spring between handle and tool over one tick, by the trapezoidal rule: N mm
/// for a stiffness of 1 N/mm.
class WorkMeter {
 public:
  explicit WorkMeter(const Guide& guide) : angular_(guide.angular_per_linear_mm2) {}

  void add(const Pose& handle, const Pose& kept) {
    const Vec3 force = handle.translation_mm - kept.translation_mm;
    const Vec3 torque =
        angular_ * (kept.rotation * small_vector_from_rotation(kept.rotation.transpose() * handle.rotation));
    if (begun_) {
      const Vec3 way = handle.translation_mm - handle_.translation_mm;
      const Vec3 turn =
          handle_.rotation * small_vector_from_rotation(handle_.rotation.transpose() * handle.rotation);
      work_ += 0.5 * (force + force_).dot(way) + 0.5 * (torque + torque_).dot(turn);
    }
    begun_ = true;
    handle_ = handle;
    force_ = force;
    torque_ = torque;
    most_stored_ = std::max(most_stored_, 0.5 * force.squaredNorm() + 0.5 / angular_ * torque.squaredNorm());
  }
  double work() const { return work_; }
  double most_stored() const { return most_stored_; }

 private:
  double angular_, work_ = 0.0, most_stored_ = 0.0;
  bool begun_ = false;
  Pose handle_;
  Vec3 force_ = Vec3::Zero(), torque_ = Vec3::Zero();
};

TEST(Guide, ClosedLoopsGiveBackNoEnergy) {
  std::mt19937 random(test::seed(5));
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  double worst_given = 0.0, worst_lost = 0.0;
  for (int loop = 0; loop < 40; ++loop) {
    const Guide guide = nipple();
    GuideState state = put_in(guide, -4.0);
    WorkMeter meter(guide);
    const double x = 0.5 * unit(random), y = 0.5 * unit(random), z = 1.0 * unit(random),
                 a = 0.08 * unit(random), b = 0.08 * unit(random), turn_1 = 3.0 * unit(random),
                 turn_2 = 3.0 * unit(random);
    constexpr int ticks = 8000;
    for (int i = 0; i <= ticks; ++i) {
      const double t = 6.283185307179586 * i / ticks;
      const Pose handle = tilted(Vec3(x * std::sin(t), y * std::sin(2 * t + turn_1) - y * std::sin(turn_1),
                                      -4.0 + z * (1.0 - std::cos(t))),
                                 a * std::sin(t + turn_2) - a * std::sin(turn_2), b * (std::cos(t) - 1.0));
      meter.add(handle, constrained(guide, state, handle));
    }
    const double share = meter.work() / std::max(meter.most_stored(), 1e-3);
    worst_given = std::min(worst_given, share);
    worst_lost = std::max(worst_lost, share);
  }
  EXPECT_GT(worst_given, -0.01) << "seed 5";
  RecordProperty("worst_lost", std::to_string(worst_lost));
}

TEST(Guide, ComingBackItDoesNotStick) {
  const Guide guide = nipple();
  GuideState state = put_in(guide, 1.0);
  for (int i = 0; i <= 100; ++i) constrained(guide, state, tilted(Vec3(0.02 * i, 0, 1.0), 0.001 * i, 0.0));
  for (int i = 100; i-- > 0;) {
    const Pose handle = tilted(Vec3(0.02 * i, 0, 1.0), 0.001 * i, 0.0);
    const Pose kept = constrained(guide, state, handle);
    if (i < 5) {
      EXPECT_EQ(kept.translation_mm, handle.translation_mm) << i;
    }
  }
  // Straight out, the tool follows at once; leaning on the wall it is a little ahead, never behind.
  for (double z = 1.0; z > -8.0; z -= 0.1) {
    EXPECT_EQ(constrained(guide, state, upright(0.05, 0, z)).translation_mm.z(), z);
    const double leaning_z = constrained(guide, state, upright(0.3, 0, z - 0.05)).translation_mm.z();
    EXPECT_LE(leaning_z, z - 0.05);
    EXPECT_NEAR(leaning_z, z - 0.05, 0.01);
  }
}

TEST(Guide, AnyPoseGivesAPose) {
  std::mt19937 random(test::seed(99));
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const Guide& guide : {nipple(), pin_guide()}) {
    GuideState state = put_in(guide, guide.mouth_mm + 1.0);
    for (int i = 0; i < 20000; ++i) {
      const Vec3 axis(unit(random), unit(random), unit(random));
      const Pose handle{rotation_from_small_vector(20.0 * axis),
                        Vec3(50.0 * unit(random), 50.0 * unit(random), 100.0 * unit(random))};
      const Pose kept = constrained(guide, state, handle);
      ASSERT_TRUE(kept.rotation.allFinite() && kept.translation_mm.allFinite()) << "seed 99, pose " << i;
      EXPECT_LT((kept.rotation.transpose() * kept.rotation - Mat3::Identity()).norm(), 1e-9);
    }
  }
}

}  // namespace
}  // namespace ream::force
