#include "device/device_setup.hpp"

#include <Eigen/LU>

#include "support/places.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "support/expect_error.hpp"
#include "support/json_schema.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"
#include "support/temporary_folder.hpp"

namespace ream::device {
namespace {

using nlohmann::json;
using test::expect_error;

bool is_rotation(const Mat3& r) {
  return (r * r.transpose() - Mat3::Identity()).norm() < 1e-12 && r.determinant() > 0.0;
}

TEST(DeviceSetup, SquareMotionsOfAnyLengthGiveTheirRotationBack) {
  std::mt19937 random(test::seed(6));
  for (int i = 0; i < 200; ++i) {
    const Mat3 device_from_person = test::random_pose(random).rotation;
    std::uniform_real_distribution<double> length_mm(10.1, 300.0);
    const Mat3 found = person_from_motions(length_mm(random) * device_from_person.col(0),
                                           length_mm(random) * device_from_person.col(1),
                                           length_mm(random) * device_from_person.col(2));
    EXPECT_LT((found * device_from_person - Mat3::Identity()).norm(), 1e-12) << "seed 6, case " << i;
  }
}

/// No other rotation brings the three directions nearer to x, y and z.
TEST(DeviceSetup, CrookedMotionsGiveTheNearestRotation) {
  std::mt19937 random(test::seed(7));
  for (int i = 0; i < 100; ++i) {
    const Mat3 device_from_person = test::random_pose(random).rotation;
    Mat3 directions;
    for (int axis = 0; axis < 3; ++axis)
      directions.col(axis) = (device_from_person.col(axis) + test::random_vector(random, 0.12)).normalized();
    const Mat3 found =
        person_from_motions(60.0 * directions.col(0), 80.0 * directions.col(1), 70.0 * directions.col(2));
    ASSERT_TRUE(is_rotation(found)) << "seed 7, case " << i;
    const double distance = (found * directions - Mat3::Identity()).norm();
    for (int other = 0; other < 50; ++other) {
      const Mat3 near = found * test::rotation_about(test::random_direction(random), 0.02 * (other + 1));
      EXPECT_LE(distance, (near * directions - Mat3::Identity()).norm()) << "seed 7, case " << i;
    }
  }
}

TEST(DeviceSetup, MotionsThatTellNothingAreRefusedInWords) {
  const Vec3 x(50, 0, 0), y(0, 50, 0), z(0, 0, 50);
  expect_error(ErrorKind::invalid_input, "to the right was only 4 mm",
               [&] { person_from_motions(Vec3(4, 0, 0), y, z); });
  expect_error(ErrorKind::invalid_input, "towards you", [&] { person_from_motions(x, y, Vec3::Zero()); });
  expect_error(ErrorKind::invalid_input, "almost the same way",
               [&] { person_from_motions(x, Vec3(50, 20, 0), z); });
  expect_error(ErrorKind::invalid_input, "almost the same way", [&] { person_from_motions(x, y, -x); });
  expect_error(ErrorKind::invalid_input, "mirrored", [&] { person_from_motions(x, y, -z); });
  expect_error(ErrorKind::invalid_input, "not a number",
               [&] { person_from_motions(Vec3(std::nan(""), 0, 0), y, z); });
}

TEST(DeviceSetup, AxesInWords) {
  EXPECT_EQ(person_from_axes("x,y,z"), Mat3(Mat3::Identity()));
  const Mat3 turned = person_from_axes("-y,z,-x");
  EXPECT_TRUE(is_rotation(turned));
  EXPECT_EQ(Vec3(turned * Vec3(0, -1, 0)), Vec3(1, 0, 0));
  for (const char* wrong : {"", "x", "x,y", "x,y,y", "x,y,-z", "x,y,z,x", "a,b,c", "x,,z", "xx,y,z"})
    expect_error(ErrorKind::invalid_input, "must name", [&] { person_from_axes(wrong); });
}

TEST(DeviceSetup, AwayFromThePersonIsIntoTheBoneAndUpIsTowardsTheHead) {
  std::mt19937 random(test::seed(8));
  for (int i = 0; i < 100; ++i) {
    const Vec3 axis = test::random_direction(random);
    const Mat3 r = world_from_person(3.0 * axis);
    ASSERT_TRUE(is_rotation(r));
    EXPECT_LT((r * Vec3(0, 0, -1) - axis).norm(), 1e-12);
    if (std::abs(axis.z()) > 0.98) continue;
    EXPECT_GT(r.col(1).z(), 0.0) << "seed 8, case " << i;
    EXPECT_NEAR(r.col(0).z(), 0.0, 1e-12) << "right is level";
  }
  EXPECT_GT(-world_from_person(Vec3(0, 0, 1)).col(1).y(), 0.9) << "to the front, along the body";
}

/// The reflected tool is where the reflected handle has it.
TEST(DeviceSetup, ALeftHandsGripIsTheMirrorImageOfARightOnes) {
  std::mt19937 random(test::seed(9));
  DeviceSetup right, left;
  left.hand = Hand::left;
  right.handle_from_tool = left.handle_from_tool = test::random_pose(random).rotation;
  const auto mirrored = [](Vec3 v) { return Vec3(-v.x(), v.y(), v.z()); };
  EXPECT_TRUE(is_rotation(handle_from_tool(left)));
  for (int i = 0; i < 20; ++i) {
    const Vec3 v = test::random_vector(random, 1.0);
    EXPECT_LT((handle_from_tool(left) * mirrored(v) - mirrored(handle_from_tool(right) * v)).norm(), 1e-12);
  }
}

TEST(DeviceSetup, AHandleThatSensesNoTurnKeepsThePlannedAxis) {
  std::mt19937 random(test::seed(11));
  for (const char* device : {"haply", "forcedimension", "openhaptics", "network"})
    for (const Hand hand : {Hand::right, Hand::left}) {
      const DeviceSetup usual = default_device_setup(device);
      EXPECT_TRUE(is_rotation(usual.person_from_device)) << device;
      EXPECT_TRUE(is_rotation(usual.handle_from_tool)) << device;
      DeviceSetup setup = usual;
      setup.hand = hand;
      setup.person_from_device = test::random_pose(random).rotation;
      setup.handle_from_tool = test::random_pose(random).rotation;
      const Vec3 axis = test::random_direction(random);
      const Mat3 world_from_tool = world_from_person(axis) * setup.person_from_device *
                                   unsensed_rotation(setup) * handle_from_tool(setup);
      EXPECT_LT((world_from_tool.col(2) - axis).norm(), 1e-12) << device;
      const Mat3 neutral = usual.person_from_device * usual.handle_from_tool;
      EXPECT_LT((neutral.col(2) + Vec3::UnitZ()).norm(), 1e-12) << device << ": away from the person";
    }
}

std::string complaint(const json& setup) {
  try {
    parse_device_setup(setup, "touch.json");
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(DeviceSetup, AFileKeepsAllOfItAndIsAsTheSchemaSays) {
  std::mt19937 random(test::seed(10));
  const test::TemporaryFolder folder;
  DeviceSetup setup;
  setup.person_from_device = test::random_pose(random).rotation;
  setup.handle_from_tool = test::random_pose(random).rotation;
  setup.scale = 2.5;
  setup.hand = Hand::left;
  setup.connection = {"10.0.0.7", 10002, 0, HaplyForceForm::values, "049D", "61548", "/opt/libdhd.so", false};
  save_device_setup(folder.path(), "touch", setup);
  const DeviceSetup found = load_device_setup(folder.path(), "touch");
  EXPECT_EQ(found.person_from_device, setup.person_from_device);
  EXPECT_EQ(found.handle_from_tool, setup.handle_from_tool);
  EXPECT_EQ(found.scale, setup.scale);
  EXPECT_EQ(found.hand, setup.hand);
  EXPECT_EQ(found.connection, setup.connection);
  const json schema = read_json_file(test::source_folder() + "/proto/device-setup.schema.json");
  const json written = read_json_file(device_setup_path(folder.path(), "touch"));
  EXPECT_EQ(test::schema_faults(schema, written), std::vector<std::string>{});
  EXPECT_EQ(load_device_setup(folder.path(), "other").scale, 1.0) << "without a file: as it is made";
}

TEST(DeviceSetup, SchemaAndReaderRefuseTheSame) {
  const json schema = read_json_file(test::source_folder() + "/proto/device-setup.schema.json");
  const json good = to_json(DeviceSetup{});
  EXPECT_EQ(complaint(good), "");
  const std::vector<std::pair<std::string, json>> wrong{
      {"axes", nullptr},
      {"axes", {{"right", {1, 0, 0}}}},
      {"scale", 0.0},
      {"scale", "much"},
      {"hand", "both"},
      {"colour", "red"},
      {"grip", 1},
      {"connection", 7},
      {"connection", {{"colour", "red"}}},
      {"connection", {{"host", ""}}},
      {"connection", {{"port", 0}}},
      {"connection", {{"events_port", 65536}}},
      {"connection", {{"force_form", "matrix"}}},
      {"connection", {{"spindle", "sometimes"}}},
      {"scale", 21},
      {"axes", {{"right", {1, 0, 0}}, {"up", {0, 1, 0}}, {"towards", {0, 0, 1}}, {"down", {0, 0, 1}}}}};
  for (const auto& [key, value] : wrong) {
    json setup = good;
    setup[key] = value;
    EXPECT_NE(complaint(setup), "") << key << ' ' << value;
    EXPECT_FALSE(test::schema_faults(schema, setup).empty()) << key << ' ' << value;
  }
  json mirrored = good;
  mirrored["axes"]["towards"] = {0, 0, -1};
  EXPECT_NE(complaint(mirrored).find("right-handed"), std::string::npos);
  json unknown = good;
  unknown["colour"] = "red";
  EXPECT_NE(complaint(unknown).find("colour"), std::string::npos);
}

}  // namespace
}  // namespace ream::device
