#include "record/op_log.hpp"

#include <gtest/gtest.h>

#include "core/file.hpp"
#include "support/example_log.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::record {
namespace {

using test::add_example_chunk;
using test::all_of;
using test::example_op;
using test::expect_error;
using test::ops_in;

class OpLogTest : public testing::Test {
 protected:
  std::filesystem::path write_example() {
    test::write_example_log(create_log_file(path_));
    return path_;
  }

  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "recording.ream";
};

TEST_F(OpLogTest, WhatWasWrittenIsRead) {
  const OpLogReader log(write_example());
  EXPECT_EQ(log.revision(), ops::newest_revision);
  EXPECT_EQ(log.damage(), "");
  EXPECT_EQ(log.whole_bytes(), std::filesystem::file_size(path_));
  EXPECT_EQ(all_of<ops::Header>(log), std::vector{example_op<ops::Header>(7)});
  EXPECT_EQ(all_of<ops::Segment>(log), std::vector{example_op<ops::Segment>(7)});
  EXPECT_EQ(all_of<ops::Event>(log), std::vector{example_op<ops::Event>(7)});
  EXPECT_EQ(all_of<ops::Annotation>(log), std::vector{example_op<ops::Annotation>(7)});
  EXPECT_EQ(all_of<ops::End>(log), std::vector{example_op<ops::End>(7)});
  EXPECT_EQ(all_of<ops::Checkpoint>(log).size(), 3u);
  const auto ticks = all_of<ops::Tick>(log);
  ASSERT_EQ(ticks.size(), 130u);
  for (uint32_t i = 0; i < ticks.size(); ++i) EXPECT_EQ(ticks[i], test::example_tick(i)) << i;
}

TEST_F(OpLogTest, ChunkHeadersSayWhatChunksHold) {
  const OpLogReader log(write_example());
  const auto& chunks = log.chunks();
  ASSERT_EQ(chunks.size(), 4u);
  const std::vector<uint32_t> first_ticks = {0, 50, 0, 100}, ticks = {50, 50, 0, 30};
  const std::vector<bool> keys = {true, false, false, true}, notes = {true, true, true, true};
  for (size_t i = 0; i < chunks.size(); ++i) {
    EXPECT_EQ(chunks[i].first_tick, first_ticks[i]) << i;
    EXPECT_EQ(chunks[i].ticks, ticks[i]) << i;
    EXPECT_EQ(chunks[i].has_key, keys[i]) << i;
    EXPECT_EQ(chunks[i].has_notes, notes[i]) << i;
    EXPECT_EQ(log.read_chunk(i).size(), chunks[i].raw_bytes) << i;
  }
}

TEST_F(OpLogTest, AChunkOfTicksBricksAndCheckpointHasNoNotes) {
  OpLogWriter log(create_log_file(path_));
  log.add(example_op<ops::Header>(1));
  log.close_chunk();
  add_example_chunk(log, 0, 3, false);
  log.close_chunk();
  EXPECT_FALSE(OpLogReader(path_).chunks().at(1).has_notes);
}

TEST_F(OpLogTest, ATickOpStandsWhereItsFirstRowStood) {
  OpLogWriter log(create_log_file(path_));
  log.add(example_op<ops::Header>(1));
  log.add(test::example_tick(0));
  log.add(example_op<ops::Event>(1));
  log.add(test::example_tick(1));
  log.close_chunk();
  std::string order;
  ops::read(OpLogReader(path_).read_chunk(0), ops::newest_revision,
            [&]<typename Op>(const Op&) { order += std::string(Op::name) + " "; });
  EXPECT_EQ(order, "header tick tick event ");
}

TEST_F(OpLogTest, NothingIsWrittenBeforeAChunkIsClosed) {
  OpLogWriter log(create_log_file(path_));
  log.close_chunk();
  log.add(example_op<ops::Header>(1));
  EXPECT_EQ(std::filesystem::file_size(path_), 0u);
  log.close_chunk();
  EXPECT_EQ(std::filesystem::file_size(path_), log.bytes_written());
}

TEST_F(OpLogTest, EqualOpsGiveEqualBytes) {
  write_example();
  const auto other = folder_.path() / "other.ream";
  test::write_example_log(create_log_file(other));
  EXPECT_EQ(read_binary_file(path_), read_binary_file(other));
}

TEST_F(OpLogTest, GoesOnAfterWhatWasWhole) {
  write_example();
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - 3);
  const OpLogReader cut(path_);
  EXPECT_NE(cut.damage(), "");
  ASSERT_EQ(cut.chunks().size(), 3u);
  {
    OpLogWriter log(continue_log_file(path_, cut.whole_bytes()), cut.chain());
    add_example_chunk(log, 100, 7, false);
    log.close_chunk();
  }
  const OpLogReader whole(path_);
  EXPECT_EQ(whole.damage(), "");
  ASSERT_EQ(whole.chunks().size(), 4u);
  EXPECT_EQ(all_of<ops::Tick>(whole).size(), 107u);
}

TEST_F(OpLogTest, AFileHasOneWriterAndIsNotReplaced) {
  const auto first = create_log_file(path_);
  expect_error(ErrorKind::io, path_.string(), [&] { create_log_file(path_); });
  expect_error(ErrorKind::conflict, path_.string(), [&] { continue_log_file(path_, 0); });
}

TEST_F(OpLogTest, WhatIsNoRecordingIsRefused) {
  for (const char* text : {"", "reamrec", "reamrec2aaaaaaaaaaaaaaaaaaaaaaaa",
                           "reamrec\naaaaaaaaaaaaaaaaaaaaaaaa", "PNG", "{\"case\": \"demo\"}"})
    expect_error(ErrorKind::invalid_input, "other.ream",
                 [&] { OpLogReader(folder_.write("other.ream", text)); });
  expect_error(ErrorKind::not_found, "absent.ream", [&] { OpLogReader(folder_.path() / "absent.ream"); });
  expect_error(ErrorKind::invalid_input, folder_.path(), [&] { OpLogReader(folder_.path()); });
}

}  // namespace
}  // namespace ream::record
