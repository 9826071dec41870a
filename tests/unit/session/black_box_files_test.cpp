#include "session/folder/black_box_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/file.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::session {
namespace {

sim::BlackBox filled(uint32_t ticks) {
  sim::BlackBox box;
  for (uint32_t tick = 0; tick < ticks; ++tick) {
    record::TickReport report;
    report.tick = tick;
    box.remember(report);
  }
  return box;
}

TEST(BlackBoxFiles, HoldTheLastTwoSecondsOldestFirst) {
  const test::TemporaryFolder folder;
  const auto path = write_black_box(filled(5000), folder.path(), 4999);
  EXPECT_EQ(path.filename(), "black-box-4999.csv");
  const std::string text = read_text_file(path);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2001);
  EXPECT_NE(text.find("\n3000,"), std::string::npos);
  EXPECT_LT(text.find("\n3000,"), text.find("\n4999,"));
  EXPECT_EQ(text.find("\n2999,"), std::string::npos);
}

TEST(BlackBoxFiles, TheNewestEightAreKeptAndNothingElseIsTouched) {
  const test::TemporaryFolder folder;
  const sim::BlackBox box = filled(3);
  for (const char* other : {"black-box-.csv", "black-box-x.csv", "black-box.csv", "recording.ream"})
    folder.write(other, "mine");
  for (uint32_t tick = 90; tick < 120; ++tick) write_black_box(box, folder.path(), tick);
  const auto boxes = black_boxes_in(folder.path());
  ASSERT_EQ(boxes.size(), max_black_boxes);
  EXPECT_EQ(boxes.front().filename(), "black-box-112.csv");
  EXPECT_EQ(boxes.back().filename(), "black-box-119.csv");
  for (const char* other : {"black-box-.csv", "black-box-x.csv", "black-box.csv", "recording.ream"})
    EXPECT_EQ(read_text_file(folder.path() / other), "mine");
}

TEST(BlackBoxFiles, AFolderThatIsNotThereIsSaid) {
  const test::TemporaryFolder folder;
  test::expect_error(ErrorKind::io, "nowhere",
                     [&] { write_black_box(filled(1), folder.path() / "nowhere", 1); });
}

}  // namespace
}  // namespace ream::session
