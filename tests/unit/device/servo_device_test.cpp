#include "device/vendors/servo_device.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <cmath>
#include <functional>
#include <limits>
#include <new>
#include <thread>

#include "core/error.hpp"
#include "device/profiles.hpp"
#include "support/expect_error.hpp"
#include "support/wait_until.hpp"

namespace ream::device {
namespace {

using namespace std::chrono_literals;

constexpr int64_t ns_per_millisecond = 1'000'000;
std::atomic<int64_t> now_ns{0};
int64_t test_clock() { return now_ns; }

ServoState at(double x_mm) {
  ServoState state;
  state.device_from_handle.translation_mm = Vec3(x_mm, 0, 0);
  return state;
}

class ServoEndTest : public testing::Test {
 protected:
  ServoEndTest() {
    now_ns = 1000 * ns_per_millisecond;
    end.open();
    servo.begin();
  }
  /// The haptic thread answers the newest pose with a force.
  void answer(const Vec3& force_n, const Vec3& torque_n_mm = Vec3::Zero()) {
    RemoteInput ignored;
    end.take(ignored);
    end.take(ignored);
    DeviceOutput output;
    output.force_n = force_n;
    output.torque_n_mm = torque_n_mm;
    end.write(output);
  }
  std::shared_ptr<RemoteLink> link = std::make_shared<RemoteLink>();
  RemoteEnd end{link, test_clock};
  ServoEnd servo{link, 5.0, 10.0, test_clock};
};

TEST_F(ServoEndTest, PassesOnWhatAnswersItsOwnPoses) {
  EXPECT_TRUE(servo.force().is_zero());
  answer({1, 2, 3});
  EXPECT_TRUE(servo.force().is_zero()) << "nobody has said a pose yet";
  EXPECT_TRUE(servo.report(at(1), now_ns));
  answer({1, 2, 3}, {4, 0, 0});
  EXPECT_EQ(servo.force().force_n, Vec3(1, 2, 3));
  EXPECT_EQ(servo.force().torque_n_mm, Vec3(4, 0, 0));
  servo.begin();
  EXPECT_TRUE(servo.force().is_zero()) << "what answered an earlier connection is for nobody";
}

TEST_F(ServoEndTest, CutsToTheLimitsAndKeepsTheDirection) {
  servo.report(at(1), now_ns);
  answer({30, 0, 40}, {0, 100, 0});
  EXPECT_LT((servo.force().force_n - Vec3(3, 0, 4)).norm(), 1e-12);
  EXPECT_LT((servo.force().torque_n_mm - Vec3(0, 10, 0)).norm(), 1e-12);
  servo.limit_force(1.0);
  EXPECT_LT((servo.force().force_n - Vec3(0.6, 0, 0.8)).norm(), 1e-12);
}

TEST_F(ServoEndTest, TakesAnOldForceBack) {
  servo.report(at(1), now_ns);
  answer({1, 0, 0});
  now_ns += 20 * ns_per_millisecond;
  EXPECT_FALSE(servo.force().is_zero());
  now_ns += 1;
  EXPECT_TRUE(servo.force().is_zero());
  answer({1, 0, 0});
  EXPECT_FALSE(servo.force().is_zero());
  end.take_force_away();
  EXPECT_TRUE(servo.force().is_zero());
}

TEST_F(ServoEndTest, RefusesWhatIsNoPoseOrNoForce) {
  servo.report(at(1), now_ns);
  for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity(), 2001.0})
    EXPECT_FALSE(servo.report(at(wrong), now_ns)) << wrong;
  ServoState turned = at(1);
  turned.device_from_handle.rotation(0, 0) = 0.5;
  EXPECT_FALSE(servo.report(turned, now_ns));
  turned.device_from_handle.rotation = Vec3(1, 1, -1).asDiagonal();
  EXPECT_FALSE(servo.report(turned, now_ns)) << "a mirror";
  EXPECT_EQ(link->refused, 5u);
  answer({1, std::nan(""), 0});
  EXPECT_TRUE(servo.force().is_zero());
}

/// Hardware in the memory of the test.
struct Rack {
  std::atomic<bool> there{true}, usable{true}, memory{true}, stuck{false}, is_stuck{false};
  std::atomic<int> turns{0}, opened{0}, tried{0}, priority{-1};
  std::atomic<double> force_n{0.0};
  std::string diary;  ///< while nothing runs
};

class RackServo final : public Servo {
 public:
  explicit RackServo(Rack& rack) : rack_(rack) {}
  void open(ServoEnd&) override {
    ++rack_.tried;
    if (!rack_.memory) throw std::bad_alloc();
    if (!rack_.there) throw Error(ErrorKind::unavailable, "the rack is empty");
    int policy = SCHED_OTHER;
    sched_param parameters{};
    ::pthread_getschedparam(::pthread_self(), &policy, &parameters);
    rack_.priority = parameters.sched_priority;
    ++rack_.opened;
    rack_.diary += "open ";
  }
  void turn(ServoEnd& end) override {
    if (!rack_.there) throw Error(ErrorKind::unavailable, "the rack is empty now");
    if (!rack_.usable) throw Error(ErrorKind::io, "the rack is broken");
    for (; rack_.stuck; rack_.is_stuck = true) std::this_thread::sleep_for(1ms);
    rack_.force_n = end.force().force_n.norm();
    end.report(at(1), end.now_ns());
    ++rack_.turns;
  }
  bool takes_force_elsewhere() const noexcept override { return false; }
  void close() noexcept override {
    rack_.force_n = 0.0;
    rack_.diary += "close ";
  }

 private:
  Rack& rack_;
};

class ServoDeviceTest : public testing::Test {
 protected:
  static void until(const std::function<bool()>& condition) { test::wait_until("the driver", condition); }
  /// The haptic thread's ticks until its force is rendered.
  void press() { press(device); }
  void press(ServoDevice& pressed) {
    until([&] {
      pressed.read(input);
      DeviceOutput output;
      output.force_n = Vec3(1, 0, 0);
      pressed.write(output);
      return rack.force_n > 0.0;
    });
  }
  void press_in_vain(ServoDevice& pressed) {
    const int turns = rack.turns;
    until([&] {
      DeviceOutput output;
      output.force_n = Vec3(1, 0, 0);
      pressed.write(output);
      return rack.turns > turns + 2;
    });
    EXPECT_EQ(rack.force_n, 0.0);
  }
  Rack rack;
  DeviceInput input;
  ServoDevice device{device_profile("touch"), std::make_unique<RackServo>(rack)};
};

TEST_F(ServoDeviceTest, OpensRendersAndLeavesNoForce) {
  device.open();
  press();
  EXPECT_EQ(input.world_from_handle.translation_mm, Vec3(1, 0, 0));
  device.close();
  EXPECT_EQ(rack.force_n, 0.0);
  EXPECT_EQ(rack.diary, "open close ");
  device.open();
  press();
}

TEST_F(ServoDeviceTest, SaysInItsDriversWordsWhyItCannotBeOpened) {
  rack.there = false;
  test::expect_error(ErrorKind::unavailable, "the rack is empty", [&] { device.open(); });
  rack.there = true;
  device.open();
  press();
}

TEST_F(ServoDeviceTest, IsOpenedAgainWhenItHasGone) {
  device.open();
  press();
  rack.there = false;
  until(
      [&] { return rack.force_n == 0.0 && device.read(input) == DeviceStatus::ok && input.age_ms > 100.0; });
  rack.there = true;
  press();
  EXPECT_EQ(rack.opened, 2);
  device.close();
  EXPECT_EQ(rack.force_n, 0.0);
}

TEST_F(ServoDeviceTest, IsOpenedAgainWhateverWentWrongMeanwhile) {
  device.open();
  press();
  rack.memory = rack.there = false;
  until([&] { return rack.tried >= 3; });
  EXPECT_EQ(device.read(input), DeviceStatus::ok);
  rack.memory = rack.there = true;
  press();
  EXPECT_EQ(rack.opened, 2);
}

TEST_F(ServoDeviceTest, IsAFaultWhenItCannotBeUsedAnyMore) {
  device.open();
  press();
  rack.usable = false;
  until([&] { return device.read(input) == DeviceStatus::fault; });
  EXPECT_EQ(device.write({}), DeviceStatus::fault);
  EXPECT_EQ(rack.force_n, 0.0);
}

TEST_F(ServoDeviceTest, AForceThatIsNotRenewedIsTakenBackWhileItTurns) {
  device.open();
  press();
  const int turns = rack.turns;
  until([&] { return rack.force_n == 0.0; });
  EXPECT_GT(rack.turns, turns);
}

/// The time of the thread that asks: for one that takes a force away it goes on only as the test says, so
/// that no machine that is busy elsewhere can use up the driver's 10 ms.
thread_local int64_t step_ns = -1;  ///< by which it goes on when it is asked; negative: as the real time does
int64_t patient_clock() {
  thread_local int64_t now = 1;
  return step_ns < 0 ? steady_ns() : now += step_ns;
}

class TakenAway : public ServoDeviceTest {
 protected:
  ~TakenAway() override { step_ns = -1; }
  ServoDevice patient{device_profile("touch"), std::make_unique<RackServo>(rack), patient_clock};
};

TEST_F(TakenAway, TheForceIsGoneWhenTheCallReturns) {
  for (int round = 0; round < 20; ++round) {
    patient.open();
    press(patient);
    step_ns = 0;
    patient.take_force_away();
    EXPECT_EQ(rack.force_n, 0.0) << round;
    step_ns = -1;
    press_in_vain(patient);
  }
}

TEST_F(TakenAway, ADriverThatDoesNotTurnIsWaitedForNoLongerThanTenMilliseconds) {
  patient.open();
  press(patient);
  rack.stuck = true;
  until([&] { return rack.is_stuck.load(); });
  step_ns = 1'000'000;
  patient.take_force_away();  // would not return
  step_ns = -1;
  rack.stuck = false;
  press_in_vain(patient);
}

/// What the kernel grants a new thread.
int granted(int fifo_priority) {
  int priority = 0;
  std::thread([&] {
    sched_param parameters{};
    parameters.sched_priority = fifo_priority;
    if (::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters) == 0) priority = fifo_priority;
  }).join();
  return priority;
}

TEST_F(ServoDeviceTest, ItsThreadRunsAtThePriorityThatItIsTold) {
  for (const int wanted : {39, 0}) {
    device.use_priority(wanted);
    device.open();
    EXPECT_EQ(rack.priority, wanted == 0 ? 0 : granted(wanted));
    device.close();
  }
}

/// Hardware that asks for the force in a loop of its own, as OpenHaptics does. It is told forces whose parts
/// are all alike, so that one read while it is written shows.
class LoopingServo final : public Servo {
 public:
  static inline thread_local bool in_turn_thread = false;
  static inline std::atomic<int> asked_in_turn_thread{0}, torn{0}, forces{0};
  /// Every look for a force asks for the time.
  static int64_t clock() {
    if (in_turn_thread) ++asked_in_turn_thread;
    return steady_ns();
  }

  bool takes_force_elsewhere() const noexcept override { return true; }
  void open(ServoEnd& end) override {
    in_turn_thread = true;
    leaving_ = false;
    loop_ = std::thread([this, &end] {
      while (!leaving_) {
        const ServoForce force = end.force();
        const Vec3& f = force.force_n;
        if (f.x() != f.y() || f.y() != f.z() || force.torque_n_mm != f) ++torn;
        if (f.x() != 0.0) ++forces;
        end.report(at(1), end.now_ns());
      }
    });
  }
  void turn(ServoEnd&) override { std::this_thread::sleep_for(100us); }
  void close() noexcept override {
    leaving_ = true;
    if (loop_.joinable()) loop_.join();
  }

 private:
  std::atomic<bool> leaving_{false};
  std::thread loop_;
};

TEST(ServoDevice, LeavesTheForceToTheHardwaresOwnLoop) {
  ServoDevice device(device_profile("ideal"), std::make_unique<LoopingServo>(), LoopingServo::clock);
  device.open();
  DeviceInput input;
  for (int i = 0; i < 20'000'000 && LoopingServo::forces < 20'000; ++i) {
    device.read(input);
    DeviceOutput output;
    output.force_n = output.torque_n_mm = Vec3::Constant(1.0 + i % 100);
    device.write(output);
  }
  device.close();
  EXPECT_GE(LoopingServo::forces, 20'000);
  EXPECT_EQ(LoopingServo::torn, 0);
  EXPECT_EQ(LoopingServo::asked_in_turn_thread, 0) << "two threads read the newest force";
}

}  // namespace
}  // namespace ream::device
