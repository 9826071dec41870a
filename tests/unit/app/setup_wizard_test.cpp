#include "app/setup_wizard.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "support/expect_error.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"

namespace ream::app {
namespace {

/// A person who does as they are told: at each question about a motion the handle has gone that way.
struct Person {
  explicit Person(uint32_t number)
      : random(test::seed(number)), device_from_person(test::random_pose(random).rotation) {}

  device::DeviceSetup set_up(const std::string& answers, std::vector<Vec3> motions,
                             const device::DeviceSetup& before = {}) {
    // Where the handle is follows from how many questions have been asked.
    std::istringstream in(answers);
    const auto place = [&]() -> Vec3 {
      const auto asked = static_cast<size_t>(count(out.str(), "press Enter there"));
      Vec3 at = Vec3::Zero();
      for (size_t i = 0; i < std::min(asked, motions.size()); ++i) at += device_from_person * motions[i];
      return at + test::random_vector(random, 0.3);
    };
    return ask_for_setup(in, out, before, place, [](int) {});
  }
  static int count(const std::string& text, const std::string& word) {
    int found = 0;
    for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
    return found;
  }

  std::mt19937 random;
  Mat3 device_from_person;
  std::ostringstream out;
};

const std::vector<Vec3> good_motions{Vec3(80, 3, -2), Vec3(2, 60, 4), Vec3(-3, 1, 90)};

TEST(SetupWizard, FindsTheAxesFromThreeMotions) {
  Person person(11);
  const device::DeviceSetup setup = person.set_up("\n\n\nleft\n2.5\n", good_motions);
  const Vec3 turn_rad = turn_between(setup.person_from_device, Mat3(person.device_from_person.transpose()));
  EXPECT_LT(turn_rad.norm(), 0.1);
  EXPECT_EQ(setup.hand, device::Hand::left);
  EXPECT_EQ(setup.scale, 2.5);
}

TEST(SetupWizard, EnterKeepsWhatWasThereAndNonsenseIsAskedAgain) {
  Person person(12);
  device::DeviceSetup before;
  before.hand = device::Hand::left;
  before.scale = 3.0;
  EXPECT_EQ(person.set_up("\n\n\n\n\n", good_motions, before).scale, 3.0);
  Person other(13);
  const device::DeviceSetup setup = other.set_up("\n\n\nboth\nright\nmuch\n-1\n1.5\n", good_motions, before);
  EXPECT_EQ(setup.hand, device::Hand::right);
  EXPECT_EQ(setup.scale, 1.5);
}

TEST(SetupWizard, MotionsThatTellNothingAreAskedForAgain) {
  Person person(14);
  std::vector<Vec3> motions{Vec3(80, 0, 0), Vec3(70, 10, 0), Vec3(0, 0, 80)};
  motions.insert(motions.end(), good_motions.begin(), good_motions.end());
  person.set_up("\n\n\n\n\n\n\n\n", motions);
  EXPECT_NE(person.out.str().find("Once more"), std::string::npos);
}

TEST(SetupWizard, LeavingItIsAnErrorAndSoIsADeviceThatFallsSilent) {
  Person person(15);
  test::expect_error(ErrorKind::invalid_input, "nothing was written",
                     [&] { person.set_up("\n\n", good_motions); });
  std::istringstream in("\n\n\n\n\n");
  std::ostringstream out;
  const auto silent = []() -> Vec3 { throw Error(ErrorKind::unavailable, "the device does not answer"); };
  test::expect_error(ErrorKind::unavailable, "does not answer",
                     [&] { ask_for_setup(in, out, {}, silent, [](int) {}); });
}

}  // namespace
}  // namespace ream::app
