#include "session/live/session_recovery.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "case/plan.hpp"
#include "core/data_folder.hpp"
#include "core/file.hpp"
#include "record/recording.hpp"
#include "session/folder/recorded_annotations.hpp"
#include "session/folder/session_archive.hpp"
#include "session/scoring/rescoring.hpp"
#include "support/expect_error.hpp"
#include "support/recorded_cutting.hpp"
#include "support/temporary_folder.hpp"

namespace ream::session {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class SessionRecoveryTest : public testing::Test {
 protected:
  /// A session that is running on paper: `ticks` ticks in its recording, and no end.
  fs::path leave_running(const std::string& id, uint32_t ticks) {
    const fs::path folder = sessions_folder(data.path()) / id;
    fs::create_directories(folder);
    write_file_atomically(session_json(folder), json{{"case", "test"},
                                                     {"script", "demo"},
                                                     {"state", "running"},
                                                     {"created_utc", "2025-03-01T12:00:00Z"},
                                                     {"force_scale", 2.0}}
                                                    .dump());
    test::RecordedCutting cutting(7, {16, 16, 16});
    record::ops::Header header = cutting.header();
    header.force_scale = 2.0;
    header.plan = case_::to_json(case_::Plan{}).dump();
    header.grid = record::grid_to_text(cutting.bone.grid);
    record::Recorder recorder(record::create_log_file(recording_file(folder)), header,
                              test::RecordedCutting::segment(0), cutting.follower.data());
    cutting.run(recorder, ticks);
    return folder;  // the recorder goes without finish(), as a killed process does
  }
  json session(const fs::path& folder) { return read_json_file(session_json(folder)); }

  const test::TemporaryFolder data;
};

TEST_F(SessionRecoveryTest, ClosesWhatWasLeftRunning) {
  const fs::path folder = leave_running("aaaa", 1100);
  write_file_atomically(folder / "metrics.json.77.tmp", std::string_view("{"));
  const auto lines = recover_sessions(data.path());
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("session aaaa: the server ended in mid-session; everything up to 1.10 s is kept"),
            std::string::npos)
      << lines[0];
  EXPECT_EQ(session(folder).at("state"), "interrupted");
  EXPECT_EQ(session(folder).at("ticks"), 1100);
  const record::Recording recording(recording_file(folder), record::Recording::Trust::checked);
  EXPECT_EQ(recording.log().damage(), "");
  EXPECT_EQ(recording.tick_count(), 1100u);
  EXPECT_EQ(recording.end().value().state, "interrupted");
  EXPECT_EQ(recording.events().at(0).kind, "interrupted");
  EXPECT_EQ(read_json_file(metrics_json(folder)), Rescorer(data.path()).metrics(recording));
  EXPECT_DOUBLE_EQ(read_json_file(metrics_json(folder)).at("duration_s").get<double>(), 1.1);
  for (const auto& entry : fs::directory_iterator(folder)) EXPECT_NE(entry.path().extension(), ".tmp");
  EXPECT_TRUE(recover_sessions(data.path()).empty()) << "once is enough";
}

TEST_F(SessionRecoveryTest, CutsAwayATornTail) {
  const fs::path folder = leave_running("aaaa", 1000);
  const auto whole = read_binary_file(recording_file(folder));
  write_file_atomically(recording_file(folder), std::span(whole).first(whole.size() - 40));
  ASSERT_EQ(recover_sessions(data.path()).size(), 1u);
  const record::Recording recording(recording_file(folder), record::Recording::Trust::checked);
  EXPECT_EQ(recording.tick_count(), 750u);
  EXPECT_EQ(recording.log().damage(), "");
}

TEST_F(SessionRecoveryTest, KeepsWhatItCutsFromTheMiddle) {
  const fs::path folder = leave_running("aaaa", 2000);
  const fs::path path = recording_file(folder);
  auto bytes = read_binary_file(path);
  const uint64_t damaged = record::Recording(path).log().chunks().at(3).offset;
  bytes[damaged] ^= std::byte{1};
  write_file_atomically(path, bytes);
  ASSERT_EQ(recover_sessions(data.path()).size(), 1u);
  EXPECT_EQ(record::Recording(path).log().damage(), "");
  const auto cut = read_binary_file(path.string() + ".cut");
  EXPECT_TRUE(
      std::equal(cut.begin(), cut.end(), bytes.begin() + static_cast<std::ptrdiff_t>(damaged), bytes.end()));
}

TEST_F(SessionRecoveryTest, KeepsAFolderWithoutAUsableRecording) {
  const fs::path folder = leave_running("aaaa", 250);
  write_file_atomically(recording_file(folder), std::string_view("REAM"));
  const fs::path empty = leave_running("bbbb", 250);
  fs::remove(recording_file(empty));
  const auto lines = recover_sessions(data.path());
  ASSERT_EQ(lines.size(), 2u);
  for (const fs::path& each : {folder, empty}) {
    EXPECT_EQ(session(each).at("state"), "interrupted");
    EXPECT_NE(session(each).at("fault").get<std::string>().find("nothing of it can be used"),
              std::string::npos);
    EXPECT_FALSE(fs::exists(metrics_json(each)));
  }
  EXPECT_TRUE(fs::exists(recording_file(folder)));
}

TEST_F(SessionRecoveryTest, LeavesWhatAProcessHoldsAndWhatHasEnded) {
  const fs::path held = leave_running("aaaa", 250), ended = leave_running("bbbb", 250);
  write_file_atomically(session_json(ended), std::string_view(R"({"state": "stopped"})"));
  const auto before = read_binary_file(recording_file(held));
  const auto lock = FileLock::attempt(lock_file(held));
  EXPECT_TRUE(recover_sessions(data.path()).empty());
  EXPECT_EQ(read_binary_file(recording_file(held)), before);
  EXPECT_EQ(session(held).at("state"), "running");
}

TEST_F(SessionRecoveryTest, ARecordingThatWasClosedKeepsItsState) {
  const fs::path folder = leave_running("aaaa", 500);
  EXPECT_EQ(close_session_folder(folder, data.path(), SessionState::fault, "the disk is full"),
            "the disk is full; everything up to 0.50 s is kept");
  json running = session(folder);
  running["state"] = "running";  // as if the process had been killed before it could write session.json
  write_file_atomically(session_json(folder), running.dump());
  recover_sessions(data.path());
  EXPECT_EQ(session(folder).at("state"), "fault");
  EXPECT_EQ(session(folder).at("fault"), "the disk is full; everything up to 0.50 s is kept");
  EXPECT_EQ(record::Recording(recording_file(folder)).events().size(), 1u);
}

TEST_F(SessionRecoveryTest, WhatCannotBeWrittenLeavesEverythingAsItWas) {
  const fs::path folder = leave_running("aaaa", 600);
  const auto recording = read_binary_file(recording_file(folder));
  const std::string before = read_text_file(session_json(folder));
  const fs::path in_the_way = folder / ("session.json." + std::to_string(::getpid()) + ".tmp");
  fs::create_directories(in_the_way / "a folder");
  const auto lines = recover_sessions(data.path());
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("is left as it was"), std::string::npos) << lines[0];
  EXPECT_EQ(read_binary_file(recording_file(folder)), recording);
  EXPECT_EQ(read_text_file(session_json(folder)), before);
  EXPECT_FALSE(fs::exists(metrics_json(folder)));
  fs::remove_all(in_the_way);
  recover_sessions(data.path());
  EXPECT_EQ(session(folder).at("state"), "interrupted");
}

TEST_F(SessionRecoveryTest, RemarksGoBehindTheEnd) {
  const fs::path folder = leave_running("aaaa", 500);
  recover_sessions(data.path());
  EXPECT_TRUE(recorded_annotations(folder).empty());
  annotate_recording(folder, {"too steep", "anna", 0.25, Vec3(1, 2, 3)});
  annotate_recording(folder, {"at the end", "", {}, {}});
  const auto remarks = recorded_annotations(folder);
  ASSERT_EQ(remarks.size(), 2u);
  EXPECT_EQ(remarks[0].words, "too steep");
  EXPECT_EQ(remarks[0].author, "anna");
  EXPECT_DOUBLE_EQ(remarks[0].at_s, 0.25);
  EXPECT_EQ(remarks[0].place_mm, Vec3(1, 2, 3));
  EXPECT_DOUBLE_EQ(remarks[1].at_s, 0.5);
  EXPECT_FALSE(remarks[1].place_mm);
  const record::Recording recording(recording_file(folder), record::Recording::Trust::checked);
  EXPECT_EQ(recording.end().value().state, "interrupted");
  EXPECT_EQ(recording.tick_count(), 500u);
  test::expect_error(ErrorKind::invalid_input, "at_s", [&] {
    annotate_recording(folder, {"later", "", 0.6, {}});
  });
  const auto lock = FileLock::attempt(lock_file(folder));
  test::expect_error(ErrorKind::conflict, "in use", [&] { annotate_recording(folder, {"now", "", {}, {}}); });
}

}  // namespace
}  // namespace ream::session
