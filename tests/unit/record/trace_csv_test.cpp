#include "record/trace_csv.hpp"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "core/file.hpp"
#include "record/trace_columns.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"
#include "support/temporary_folder.hpp"
#include "support/tick_reports.hpp"

namespace ream::record {
namespace {

constexpr double voxel_volume_mm3 = 0.008;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

/// A plan 40 mm beside the world's origin whose axis is the world's x.
Pose plan_from_world() {
  return Pose{rotation_with_z_along(Vec3(1.0, 0.0, 0.0)), Vec3(40.0, 0.0, 0.0)}.inverse();
}

/// A trace read back: the numbers of each row by column name.
struct Trace {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;

  explicit Trace(const std::filesystem::path& path) {
    const auto lines = split(read_text_file(path), '\n');
    columns = split(lines.at(0), ',');
    for (size_t i = 1; i < lines.size(); ++i) {
      rows.emplace_back();
      for (const std::string& cell : split(lines[i], ',')) rows.back().push_back(std::stod(cell));
    }
  }
  double at(size_t row, const std::string& column) const {
    const auto found = std::find(columns.begin(), columns.end(), column);
    EXPECT_NE(found, columns.end()) << column;
    return rows.at(row).at(static_cast<size_t>(found - columns.begin()));
  }
};

TEST(TraceCsv, EveryRowHasAsManyCellsAsTheHeader) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "trace.csv";
  std::mt19937 random(test::seed(31));
  TraceCsv trace(path, voxel_volume_mm3, plan_from_world());
  for (uint32_t tick = 0; tick < 50; ++tick) trace.add(test::random_report(random, tick));
  trace.add({});
  trace.finish();
  const Trace read(path);
  ASSERT_EQ(read.rows.size(), 51u);
  for (const auto& row : read.rows) ASSERT_EQ(row.size(), read.columns.size());
  EXPECT_EQ(read_text_file(path).substr(0, TraceCsv::header_line().size() + 1),
            TraceCsv::header_line() + "\n");
}

TEST(TraceCsv, NumbersReadBackExactly) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "trace.csv";
  std::mt19937 random(test::seed(32));
  std::vector<TickReport> reports;
  for (uint32_t tick = 0; tick < 20; ++tick) reports.push_back(test::random_report(random, tick));
  TraceCsv trace(path, voxel_volume_mm3, plan_from_world());
  for (const TickReport& report : reports) trace.add(report);
  trace.finish();

  const Trace read(path);
  int64_t removed = 0;
  for (size_t i = 0; i < reports.size(); ++i) {
    const TickReport& r = reports[i];
    for (const int64_t levels : r.coverage_removed) removed += levels;
    EXPECT_DOUBLE_EQ(read.at(i, "t_s"), static_cast<double>(i) * 1e-3);
    EXPECT_EQ(read.at(i, "handle_x_mm"), r.world_from_handle.translation_mm.x());
    EXPECT_EQ(read.at(i, "tool_z_mm"), r.world_from_tool.translation_mm.z());
    const Mat3 rotation = rotation_from_quaternion(
        {read.at(i, "tool_qw"), read.at(i, "tool_qx"), read.at(i, "tool_qy"), read.at(i, "tool_qz")});
    EXPECT_LT((rotation - r.world_from_tool.rotation).norm(), 1e-12);
    EXPECT_EQ(read.at(i, "bone_y_mm"), r.world_from_bone_rest.translation_mm.y());
    EXPECT_EQ(read.at(i, "bone_qw"), quaternion_from_rotation(r.world_from_bone_rest.rotation)[0]);
    EXPECT_EQ(read.at(i, "spindle_on"), r.spindle_on);
    EXPECT_EQ(read.at(i, "paused"), r.paused);
    EXPECT_EQ(read.at(i, "thrust_n"), r.thrust_n);
    EXPECT_EQ(read.at(i, "hand_force_y_n"), r.hand_force_n.y());
    EXPECT_EQ(read.at(i, "torque_n_mm"), r.torque_n_mm);
    EXPECT_EQ(read.at(i, "feed_rate_mm_s"), r.feed_rate_mm_s);
    EXPECT_EQ(read.at(i, "density_g_cc"), r.density_g_cc);
    EXPECT_EQ(read.at(i, "share_cancellous"), r.share[0]);
    EXPECT_EQ(read.at(i, "share_cortical"), r.share[1]);
    EXPECT_EQ(read.at(i, "share_cartilage"), r.share[2]);
    EXPECT_EQ(read.at(i, "engaged_points"), static_cast<double>(r.engaged_points));
    EXPECT_DOUBLE_EQ(read.at(i, "removed_volume_mm3"),
                     static_cast<double>(removed) / 255.0 * voxel_volume_mm3);
  }
}

TEST(TraceCsv, DepthIsAlongThePlannedAxisWithTheBone) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "trace.csv";
  TickReport report;
  report.world_from_tool.translation_mm = Vec3(43.0, 5.0, -7.0);
  TraceCsv trace(path, voxel_volume_mm3, plan_from_world());
  trace.add(report);
  report.world_from_bone_rest.translation_mm = Vec3(2.0, 1.0, 1.0);
  trace.add(report);
  // The bone is turned by half a turn about the world's z: what was 3 mm past the entry is 83 mm before it.
  report.world_from_bone_rest = {rotation_from_quaternion({0.0, 0.0, 0.0, 1.0}), Vec3::Zero()};
  trace.add(report);
  trace.finish();
  const Trace read(path);
  EXPECT_NEAR(read.at(0, "tool_depth_mm"), 3.0, 1e-9);
  EXPECT_NEAR(read.at(1, "tool_depth_mm"), 1.0, 1e-9);
  EXPECT_NEAR(read.at(2, "tool_depth_mm"), -83.0, 1e-9);
}

TEST(TraceCsv, EveryColumnIsExplainedOnce) {
  std::set<std::string_view> names;
  for (const TraceColumn& column : trace_columns()) {
    EXPECT_TRUE(names.insert(column.name).second) << column.name;
    EXPECT_TRUE(column.meaning.ends_with(".")) << column.name;
  }
}

TEST(TraceCsv, NothingIsLeftWhenNotFinished) {
  const test::TemporaryFolder folder;
  {
    TraceCsv trace(folder.path() / "trace.csv", voxel_volume_mm3, {});
    trace.add({});
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "trace.csv"));
  }
  EXPECT_EQ(folder.entries(), std::vector<std::string>{});
}

TEST(TraceCsv, UnwritablePlacesAreNamed) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("file", "");
  test::expect_error(ErrorKind::io, "trace.csv", [&] { TraceCsv(file / "trace.csv", voxel_volume_mm3, {}); });
  std::filesystem::remove(file);

  const auto taken = folder.path() / "trace.csv";
  std::filesystem::create_directory(taken);
  {
    TraceCsv trace(taken, voxel_volume_mm3, {});
    trace.add({});
    test::expect_error(ErrorKind::io, "trace.csv", [&] { trace.finish(); });
  }
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"trace.csv"});
}

}  // namespace
}  // namespace ream::record
