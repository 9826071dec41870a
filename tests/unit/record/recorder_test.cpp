#include "record/recorder.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "support/tick_reports.hpp"

namespace ream::record {
namespace {

using test::expect_error;

constexpr size_t ticks_per_chunk = 1000, bytes_per_tick = 112, chunk_header_bytes = 16, fixed_bytes = 24;

bool same(const RecordedTick& a, const TickReport& b) {
  return a.tick == b.tick && a.spindle_on == b.spindle_on && a.paused == b.paused &&
         a.failed_over == b.failed_over && a.world_from_handle == b.world_from_handle_q &&
         a.grid_from_tool == b.grid_from_tool && a.session_hash == b.session_hash;
}

class RecorderTest : public testing::Test {
 protected:
  /// Records `reports` under `header`.
  std::filesystem::path record(const std::vector<TickReport>& reports,
                               const nlohmann::json& header = {{"case", "demo"}}) {
    const auto path = folder_.path() / "recording.ream";
    Recorder recorder(path, header);
    for (const TickReport& report : reports) recorder.add(report);
    recorder.finish();
    return path;
  }

  /// Ticks of a resting tool: they compress to little.
  static std::vector<TickReport> resting(size_t ticks) {
    std::vector<TickReport> reports(ticks);
    for (size_t i = 0; i < ticks; ++i) {
      reports[i].tick = static_cast<uint32_t>(i);
      reports[i].session_hash = 7 * i;
    }
    return reports;
  }

  std::string bytes_of(const std::filesystem::path& path) { return read_text_file(path); }

  test::TemporaryFolder folder_;
};

TEST_F(RecorderTest, ReadsBackWhatWasRecorded) {
  std::mt19937 random(21);
  std::vector<TickReport> reports;
  for (uint32_t tick = 0; tick < 2345; ++tick) reports.push_back(test::random_report(random, tick));
  const nlohmann::json header = {{"case", "demo"}, {"build", "ream 0.1.0"}};
  const Recording recording = read_recording(record(reports, header));
  EXPECT_TRUE(recording.complete);
  EXPECT_EQ(nlohmann::json::parse(recording.header_json), header);
  ASSERT_EQ(recording.ticks.size(), reports.size());
  for (size_t i = 0; i < reports.size(); ++i)
    ASSERT_TRUE(same(recording.ticks[i], reports[i])) << "tick " << i << ", seed 21";
}

TEST_F(RecorderTest, AnEmptyRecordingIsWhole) {
  const auto path = record({});
  const Recording recording = read_recording(path);
  EXPECT_TRUE(recording.complete);
  EXPECT_TRUE(recording.ticks.empty());
  EXPECT_EQ(std::filesystem::file_size(path), fixed_bytes + std::strlen(R"({"case":"demo"})"));
}

TEST_F(RecorderTest, HasTheLayoutItHadWhenThisTestWasWritten) {
  const std::string header = R"({"case":"demo"})";
  const std::string bytes = bytes_of(record(resting(ticks_per_chunk + 5)));
  EXPECT_EQ(bytes.substr(0, 8), "reamrec1");
  uint64_t header_size = 0;
  std::memcpy(&header_size, bytes.data() + 8, sizeof header_size);
  EXPECT_EQ(header_size, header.size());
  EXPECT_EQ(bytes.substr(fixed_bytes, header.size()), header);
  size_t at = fixed_bytes + header.size();
  for (const size_t ticks : {ticks_per_chunk, size_t{5}}) {
    uint32_t stored = 0, raw = 0;
    std::memcpy(&stored, bytes.data() + at, sizeof stored);
    std::memcpy(&raw, bytes.data() + at + 4, sizeof raw);
    EXPECT_EQ(raw, ticks * bytes_per_tick);
    at += chunk_header_bytes + stored;
  }
  EXPECT_EQ(at, bytes.size());
}

TEST_F(RecorderTest, EqualRunsGiveEqualBytes) {
  const auto reports = resting(1500);
  const std::string first = bytes_of(record(reports));
  EXPECT_EQ(first, bytes_of(record(reports)));
}

TEST_F(RecorderTest, CutOffAnywhereItKeepsEveryWholeChunk) {
  const auto path = record(resting(2 * ticks_per_chunk + 5));
  const std::string bytes = bytes_of(path);
  const size_t chunks_at = fixed_bytes + std::strlen(R"({"case":"demo"})");
  // Where a chunk ends, and the ticks that are whole by then.
  std::vector<std::pair<size_t, size_t>> ends = {{chunks_at, 0}};
  for (const size_t ticks : {ticks_per_chunk, 2 * ticks_per_chunk, 2 * ticks_per_chunk + 5}) {
    uint32_t stored = 0;
    std::memcpy(&stored, bytes.data() + ends.back().first, sizeof stored);
    ends.push_back({ends.back().first + chunk_header_bytes + stored, ticks});
  }
  ASSERT_EQ(ends.back().first, bytes.size());

  for (size_t size = bytes.size(); size-- > 0;) {
    std::filesystem::resize_file(path, size);
    if (size < chunks_at) {
      expect_error(ErrorKind::invalid_input, path.string(), [&] { read_recording(path); });
      continue;
    }
    size_t whole = 0;
    bool at_end_of_chunk = false;
    for (const auto& [end, ticks] : ends)
      if (end <= size) {
        whole = ticks;
        at_end_of_chunk = end == size;
      }
    const Recording recording = read_recording(path);
    ASSERT_EQ(recording.ticks.size(), whole) << "cut to " << size << " of " << bytes.size() << " bytes";
    ASSERT_EQ(recording.complete, at_end_of_chunk) << "cut to " << size << " bytes";
    for (size_t i = 0; i < whole; ++i) ASSERT_EQ(recording.ticks[i].session_hash, 7 * i);
  }
}

TEST_F(RecorderTest, ADamagedByteIsNoticedWhereverItIs) {
  const auto reports = resting(ticks_per_chunk + 5);
  const std::string bytes = bytes_of(record(reports));
  for (size_t at = 0; at < bytes.size(); ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    const auto path = folder_.write("damaged.ream", damaged);
    if (at < fixed_bytes + std::strlen(R"({"case":"demo"})")) {
      expect_error(ErrorKind::invalid_input, "damaged.ream", [&] { read_recording(path); });
      continue;
    }
    const Recording recording = read_recording(path);
    ASSERT_FALSE(recording.complete) << "byte " << at;
    ASSERT_LT(recording.ticks.size(), reports.size()) << "byte " << at;
    for (size_t i = 0; i < recording.ticks.size(); ++i) ASSERT_TRUE(same(recording.ticks[i], reports[i]));
  }
}

TEST_F(RecorderTest, AKilledProcessLosesAtMostTheLastSecond) {
  const auto path = folder_.path() / "recording.ream";
  Recorder recorder(path, {{"case", "demo"}});
  for (const TickReport& report : resting(2 * ticks_per_chunk + 500)) recorder.add(report);
  // Not finished: what is on the disk by now is what a kill would leave.
  EXPECT_EQ(read_recording(path).ticks.size(), 2 * ticks_per_chunk);
}

TEST_F(RecorderTest, WhatIsNoRecordingIsRefused) {
  for (const char* text :
       {"", "reamrec", "reamrec2aaaaaaaaaaaaaaaaaaaaaaaa", "PNG", "{\"case\": \"demo\"}"}) {
    const auto path = folder_.write("other.ream", text);
    expect_error(ErrorKind::invalid_input, "other.ream", [&] { read_recording(path); });
  }
  expect_error(ErrorKind::not_found, "absent.ream", [&] { read_recording(folder_.path() / "absent.ream"); });
}

TEST_F(RecorderTest, UnwritablePlacesAreNamed) {
  const auto file = folder_.write("file", "");
  expect_error(ErrorKind::io, "recording.ream", [&] { Recorder(file / "recording.ream", {}); });
}

}  // namespace
}  // namespace ream::record
