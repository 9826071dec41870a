#include "session/folder/session_archive.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::session {
namespace {

using nlohmann::json;
using test::expect_error;

class SessionArchiveTest : public testing::Test {
 protected:
  void put(const std::string& id, const std::string& utc, const std::string& state,
           json more = json::object()) {
    json session = {{"case", "demo"}, {"script", "demo"},    {"created_utc", utc},
                    {"state", state}, {"force_scale", 13.0}, {"ticks", 1250}};
    session.update(more);
    folder.write(id + "/session.json", session.dump());
  }
  std::vector<std::string> listed() const {
    std::vector<std::string> ids;
    for (const SessionRecord& record : archive.list()) ids.push_back(record.request.id);
    return ids;
  }

  const test::TemporaryFolder folder;
  const SessionArchive archive{folder.path()};
};

TEST_F(SessionArchiveTest, TellsWhatTheFolderSays) {
  put("aaaa", "2025-03-01T12:00:00Z", "fault", {{"fault", "the device fell silent"}});
  folder.write("aaaa/timing.json",
               R"({"tick_us": {"mean": 90.5, "max": 400.0}, "missed": 3, "ticks": 1250})");
  folder.write("aaaa/metrics.json", R"({"reaming_depth_mm": 1.5})");
  const SessionRecord record = archive.find("aaaa").value();
  EXPECT_EQ(record.request.id, "aaaa");
  EXPECT_EQ(record.request.case_id, "demo");
  EXPECT_EQ(record.request.created_utc, "2025-03-01T12:00:00Z");
  EXPECT_EQ(record.status.state, SessionState::fault);
  EXPECT_EQ(record.status.fault, "the device fell silent");
  EXPECT_EQ(record.status.tick, 1250u);
  EXPECT_DOUBLE_EQ(record.status.duration_s, 1.25);
  EXPECT_EQ(record.status.force_scale, 13.0);
  EXPECT_EQ(record.status.loop.tick_us.max_us, 400.0);
  EXPECT_EQ(record.status.loop.missed, 3u);
  EXPECT_FALSE(record.streamable);
  EXPECT_EQ(archive.metrics("aaaa").at("reaming_depth_mm"), 1.5);
}

TEST_F(SessionArchiveTest, KeepsTheDeviceForThoseWhoGoOn) {
  put("aaaa", "2025-03-01T12:00:00Z", "stopped", {{"device", "network"}, {"device_profile", "omega.3"}});
  put("bbbb", "2025-03-01T12:00:00Z", "stopped", {{"device_profile", "ideal"}});
  const SessionRecord remote = archive.find("aaaa").value(), scripted = archive.find("bbbb").value();
  EXPECT_EQ(remote.request.device, "network");
  EXPECT_EQ(remote.request.device_profile, "omega.3");
  EXPECT_EQ(remote.status.device.name, "network");
  EXPECT_EQ(scripted.request.device, "script");
  EXPECT_EQ(scripted.request.device_profile, "");
  EXPECT_EQ(scripted.status.device.profile, "ideal");
}

TEST_F(SessionArchiveTest, ListsNewestFirstAndLeavesDamagedOnesOut) {
  put("older", "2025-03-01T12:00:00Z", "finished");
  put("newest", "2025-03-03T12:00:00Z", "stopped");
  put("middle", "2025-03-02T12:00:00Z", "interrupted");
  folder.write("torn/session.json", "{\"state\": ");
  put("strange", "2025-03-04T12:00:00Z", "asleep");
  put("mistyped", "2025-03-04T12:00:00Z", "stopped", {{"ticks", "many"}});
  folder.write("empty/something.txt", "");
  folder.write("half.123.tmp/session.json", "{}");
  EXPECT_EQ(listed(), (std::vector<std::string>{"newest", "middle", "older"}));
  for (const char* id : {"torn", "strange", "mistyped"})
    expect_error(ErrorKind::invalid_input, id, [&] { archive.find(id); });
  expect_error(ErrorKind::not_found, "left no metrics", [&] { archive.metrics("older"); });
}

TEST_F(SessionArchiveTest, SeesWhatChangesLater) {
  put("aaaa", "2025-03-01T12:00:00Z", "stopped");
  EXPECT_EQ(archive.find("aaaa")->status.state, SessionState::stopped);
  put("aaaa", "2025-03-01T12:00:00Z", "finished", {{"ticks", 99}});
  EXPECT_EQ(archive.find("aaaa")->status.state, SessionState::finished);
  EXPECT_EQ(archive.list().at(0).status.tick, 99u);
  std::filesystem::remove_all(folder.path() / "aaaa");
  EXPECT_FALSE(archive.find("aaaa"));
  EXPECT_TRUE(listed().empty());
}

TEST_F(SessionArchiveTest, ALiveStateCountsWhileItsLockIsHeldOnly) {
  put("aaaa", "2025-03-01T12:00:00Z", "running");
  EXPECT_EQ(archive.find("aaaa")->status.state, SessionState::interrupted);
  {
    const auto lock = FileLock::attempt(lock_file(folder.path() / "aaaa"));
    EXPECT_EQ(archive.find("aaaa")->status.state, SessionState::running);
    EXPECT_EQ(archive.list().at(0).status.state, SessionState::running);
  }
  EXPECT_EQ(archive.list().at(0).status.state, SessionState::interrupted);
}

TEST_F(SessionArchiveTest, RunsOfTheCommandLineAreThereToo) {
  folder.write("run-1/session.json", R"({"case": "/home/anna/knee", "script": "/home/anna/steady.json"})");
  folder.write("run-1/timing.json", R"({"tick_us": {"mean": 80.0}, "missed": 0, "ticks": 3000})");
  const SessionRecord record = archive.find("run-1").value();
  EXPECT_EQ(record.request.case_id, "knee");
  EXPECT_EQ(record.request.script, "steady");
  EXPECT_EQ(record.status.state, SessionState::finished);
  EXPECT_DOUBLE_EQ(record.status.duration_s, 3.0);
  EXPECT_EQ(record.request.created_utc.size(), std::string("2025-03-01T12:00:00Z").size());
}

TEST_F(SessionArchiveTest, AnImpossibleNumberOfAttemptsIsBounded) {
  put("aaaa", "2025-03-01T12:00:00Z", "stopped", {{"attempt", 4.4e86}});
  EXPECT_EQ(archive.find("aaaa")->request.attempt, 1'000'000);
  put("bbbb", "2025-03-01T12:00:00Z", "stopped", {{"attempt", -3}});
  EXPECT_EQ(archive.find("bbbb")->request.attempt, 1);
}

TEST_F(SessionArchiveTest, IdsAreNoPathsAndAMissingFolderIsEmpty) {
  put("aaaa", "2025-03-01T12:00:00Z", "stopped");
  for (const char* id : {"..", ".", "", "aaaa/..", "/etc", "AAAA"}) EXPECT_FALSE(archive.find(id)) << id;
  EXPECT_TRUE(SessionArchive(folder.path() / "nowhere").list().empty());
}

}  // namespace
}  // namespace ream::session
