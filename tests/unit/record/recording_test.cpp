#include "record/recording.hpp"

#include <gtest/gtest.h>

#include <future>
#include <thread>

#include "core/clock.hpp"
#include "support/expect_error.hpp"
#include "support/recorded_cutting.hpp"
#include "support/seed.hpp"
#include "support/temporary_folder.hpp"

namespace ream::record {
namespace {

using test::RecordedCutting;

constexpr uint32_t recording_seed = 77;

/// Of the bone at rest, an ordinary one.
Pose world_from_grid() {
  std::mt19937 random(test::seed(3));
  return test::random_pose(random);
}

class RecordingTest : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_.path() / "recording.ream";
  RecordedCutting session_{test::seed(recording_seed), Vec3i(16, 16, 16)};

  void record(uint32_t ticks) {
    Recorder recorder(create_log_file(path_), session_.header(), RecordedCutting::segment(0),
                      session_.follower.data());
    session_.run(recorder, ticks);
    recorder.finish("finished");
  }
};

TEST_F(RecordingTest, HoldsEveryTickAsItIsKept) {
  SCOPED_TRACE(testing::Message() << "recording_seed " << test::seed(recording_seed));
  record(1777);
  const Recording recording(path_, Recording::Trust::checked);
  EXPECT_EQ(recording.log().damage(), "");
  EXPECT_EQ(recording.header().case_id, "test");
  ASSERT_EQ(recording.tick_count(), 1777u);
  const auto ticks = recording.ticks(0, UINT32_MAX);
  ASSERT_EQ(ticks.size(), session_.reports.size());
  for (size_t i = 0; i < ticks.size(); ++i) ASSERT_EQ(ticks[i], tick_op(session_.reports[i])) << "tick " << i;
  ASSERT_TRUE(recording.end());
  EXPECT_EQ(recording.end()->ticks, 1777u);
}

TEST_F(RecordingTest, AnyRangeOfTicksCanBeRead) {
  SCOPED_TRACE(testing::Message() << "recording_seed " << test::seed(recording_seed));
  record(1100);
  const Recording recording(path_);
  for (const auto& [first, last] :
       {std::pair{0u, 1u}, {249u, 251u}, {250u, 500u}, {1099u, 5000u}, {600u, 600u}}) {
    const auto ticks = recording.ticks(first, last);
    ASSERT_EQ(ticks.size(), std::min(last, 1100u) - first);
    for (size_t i = 0; i < ticks.size(); ++i) EXPECT_EQ(ticks[i].tick, first + i);
  }
  EXPECT_TRUE(recording.ticks(2000, 3000).empty());
}

TEST(TickOp, WhatIsKeptIsKeptAgainUnchanged) {
  SCOPED_TRACE(testing::Message() << "recording_seed " << test::seed(recording_seed));
  std::mt19937 random(test::seed(recording_seed));
  for (uint32_t tick = 0; tick < 500; ++tick) {
    const TickReport report = test::random_report(random, tick);
    const TickReport kept = as_recorded(report, world_from_grid());
    EXPECT_EQ(tick_op(kept), tick_op(report));
    EXPECT_EQ(tick_op(as_recorded(kept, world_from_grid())), tick_op(report));
  }
}

TEST(TickOp, ToolIsWhereItWasInTheWorld) {
  SCOPED_TRACE(testing::Message() << "recording_seed " << test::seed(recording_seed));
  std::mt19937 random(test::seed(recording_seed));
  for (int i = 0; i < 200; ++i) {
    TickReport report = test::random_report(random, 1);
    const Pose grid_from_world = (report.world_from_bone_rest * world_from_grid()).inverse();
    report.grid_from_tool = quantised(grid_from_world * report.world_from_tool);
    const TickReport kept = as_recorded(report, world_from_grid());
    EXPECT_LT((kept.world_from_tool.translation_mm - report.world_from_tool.translation_mm).norm(), 1e-5);
    EXPECT_LT((kept.world_from_tool.rotation - report.world_from_tool.rotation).norm(), 1e-7);
    EXPECT_NEAR(kept.thrust_n, report.thrust_n, 1e-6 * std::abs(report.thrust_n));
  }
}

TEST_F(RecordingTest, NotesAreThereWithoutReadingTheTicks) {
  {
    Recorder recorder(create_log_file(path_), session_.header(), RecordedCutting::segment(0),
                      session_.follower.data());
    session_.run(recorder, 300);
    recorder.add(ops::Event{300, "failover", "the device failed"});
    session_.run(recorder, 300);
    recorder.add(ops::Annotation{555, "2026-01-01T00:00:00Z", "Ada", "too steep", 1, 1.5, -2.5, 3.5});
    recorder.finish("stopped");
  }
  const Recording recording(path_);
  ASSERT_EQ(recording.segments().size(), 1u);
  ASSERT_EQ(recording.events().size(), 1u);
  EXPECT_EQ(recording.events()[0], (ops::Event{300, "failover", "the device failed"}));
  ASSERT_EQ(recording.annotations().size(), 1u);
  EXPECT_EQ(recording.annotations()[0].words, "too steep");
  EXPECT_EQ(recording.annotations()[0].z_mm, 3.5);
  EXPECT_EQ(recording.end()->state, "stopped");
}

TEST_F(RecordingTest, IsReadableFromTheStart) {
  const Recorder recorder(create_log_file(path_), session_.header(), RecordedCutting::segment(0),
                          session_.follower.data());
  const Recording recording(path_);
  EXPECT_EQ(recording.tick_count(), 0u);
  EXPECT_EQ(recording.header().case_id, "test");
  EXPECT_FALSE(recording.end());
  EXPECT_TRUE(recording.ticks(0, 10).empty());
}

/// A disk so busy that a sync does not come back until it is released.
class BusySink final : public LogSink {
 public:
  BusySink(std::unique_ptr<LogSink> file, std::promise<void>& waits, std::future<void> released)
      : file_(std::move(file)), waits_(waits), released_(std::move(released)) {}
  void append(std::span<const std::byte> bytes) override { file_->append(bytes); }
  void sync() override {
    if (syncs_++ == 0) return file_->sync();  // the one with which a recording begins
    if (syncs_ == 2) {
      waits_.set_value();
      released_.wait();
    }
    file_->sync();
  }

 private:
  std::unique_ptr<LogSink> file_;
  std::promise<void>& waits_;
  const std::future<void> released_;
  int syncs_ = 0;
};

TEST_F(RecordingTest, ChunksAreInTheFileWhileASyncWaits) {
  std::promise<void> waits, release;
  Recorder recorder(std::make_unique<BusySink>(create_log_file(path_), waits, release.get_future()),
                    session_.header(), RecordedCutting::segment(0), session_.follower.data());
  session_.run(recorder, 1000);
  waits.get_future().wait();
  session_.run(recorder, 1000);
  const auto late = SteadyClock::now() + std::chrono::seconds(60);
  while (recorder.waiting_chunks() > 0 && SteadyClock::now() < late)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(Recording(path_).tick_count(), 2000u);
  release.set_value();
  recorder.finish("finished");
  EXPECT_TRUE(Recording(path_).end());
}

/// Takes so many bytes and then is as a full disk.
class FillingSink final : public LogSink {
 public:
  FillingSink(std::unique_ptr<LogSink> file, size_t room) : file_(std::move(file)), room_(room) {}
  void append(std::span<const std::byte> bytes) override {
    const size_t fits = std::min(room_, bytes.size());
    file_->append(bytes.first(fits));
    room_ -= fits;
    if (fits < bytes.size()) throw Error(ErrorKind::io, "cannot write: No space left on device");
  }
  void sync() override { file_->sync(); }

 private:
  std::unique_ptr<LogSink> file_;
  size_t room_;
};

TEST_F(RecordingTest, AFullDiskIsSaidAndWhatCameBeforeIsWhole) {
  SCOPED_TRACE(testing::Message() << "recording_seed " << test::seed(recording_seed));
  Recorder recorder(std::make_unique<FillingSink>(create_log_file(path_), 200'000), session_.header(),
                    RecordedCutting::segment(0), session_.follower.data());
  session_.run(recorder, 4000);
  test::expect_error(ErrorKind::io, "No space left", [&] { recorder.finish("finished"); });
  EXPECT_NE(recorder.failure().find("No space left"), std::string::npos);
  const Recording recording(path_);
  EXPECT_NE(recording.log().damage(), "");
  EXPECT_FALSE(recording.end());
  EXPECT_GT(recording.tick_count(), 0u);
  EXPECT_EQ(recording.tick_count() % ticks_per_chunk, 0u);
  const auto ticks = recording.ticks(0, UINT32_MAX);
  ASSERT_EQ(ticks.size(), recording.tick_count());
  for (size_t i = 0; i < ticks.size(); ++i) ASSERT_EQ(ticks[i], tick_op(session_.reports[i]));
}

}  // namespace
}  // namespace ream::record
