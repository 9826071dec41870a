#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "core/file.hpp"
#include "core/utc.hpp"
#include "session/service/session_service.hpp"
#include "support/expect_error.hpp"
#include "support/fake_engine.hpp"
#include "support/temporary_folder.hpp"

namespace ream::session {
namespace {

namespace fs = std::filesystem;
using test::expect_error;

class SessionRemovalTest : public testing::Test {
 protected:
  void put(const std::string& id, const nlohmann::json& more = nlohmann::json::object()) const {
    nlohmann::json session = {{"case", "demo"}, {"script", "demo"}, {"state", "finished"}};
    session.update(more);
    folder.write("sessions/" + id + "/session.json", session.dump());
    folder.write("sessions/" + id + "/recording.ream", "recorded " + id);
  }
  fs::path place(const std::string& id) const { return sessions / id; }
  fs::path trash(const std::string& id) const { return folder.path() / "trash" / id; }

  const test::TemporaryFolder folder;
  const fs::path sessions = folder.path() / "sessions";
  store::Database database{"sqlite:" + (folder.path() / "ream.db").string()};
  test::FakeEngine engine;
  SessionService service{engine, {3, 2}, sessions, database};
};

TEST_F(SessionRemovalTest, GoesToTheTrashWholeAndComesBackWhole) {
  put("abcd", {{"title", "first try"}});
  EXPECT_EQ(service.remove("abcd").request.title, "first try");
  EXPECT_FALSE(fs::exists(place("abcd")));
  EXPECT_EQ(read_text_file(trash("abcd") / "recording.ream"), "recorded abcd");
  expect_error(ErrorKind::not_found, "abcd", [&] { service.get("abcd"); });
  expect_error(ErrorKind::not_found, "abcd", [&] { service.remove("abcd"); });
  EXPECT_TRUE(service.list({}).sessions.empty());
  ASSERT_EQ(service.deleted().size(), 1u);
  EXPECT_EQ(service.deleted().front().id, "abcd");
  EXPECT_EQ(service.deleted().front().record->request.title, "first try");

  EXPECT_EQ(service.restore("abcd").request.title, "first try");
  EXPECT_FALSE(fs::exists(place("abcd") / "deleted.json"));
  EXPECT_EQ(read_text_file(place("abcd") / "recording.ream"), "recorded abcd");
  EXPECT_TRUE(service.deleted().empty());
  EXPECT_EQ(service.list({}).sessions.size(), 1u);
  expect_error(ErrorKind::conflict, "is not deleted", [&] { service.restore("abcd"); });
  expect_error(ErrorKind::not_found, "no deleted session 'wxyz'", [&] { service.restore("wxyz"); });
}

TEST_F(SessionRemovalTest, WhatIsLiveInUseOrKeptStays) {
  const std::string live = service.create({{}, "demo", "demo", {}}).request.id;
  expect_error(ErrorKind::conflict, "is created; stop it", [&] { service.remove(live); });
  service.start(live);
  expect_error(ErrorKind::conflict, "is running; stop it", [&] { service.remove(live); });
  expect_error(ErrorKind::conflict, "is not deleted", [&] { service.restore(live); });
  put("used");
  {
    const auto lock = FileLock::attempt(lock_file(place("used")));
    expect_error(ErrorKind::conflict, "in use", [&] { service.remove("used"); });
  }
  service.remove("used");
  put("kept", {{"keep", true}});
  expect_error(ErrorKind::conflict, "kept for good", [&] { service.remove("kept"); });
  EXPECT_TRUE(fs::exists(place("kept") / "recording.ream"));
}

TEST_F(SessionRemovalTest, OneInMemoryIsForgottenToo) {
  const std::string id = service.create({{}, "demo", "demo", {}}).request.id;
  service.stop(id);
  const int alive = test::FakeSession::alive();
  EXPECT_FALSE(service.remove(id).streamable);
  EXPECT_EQ(test::FakeSession::alive(), alive - 1);
  expect_error(ErrorKind::not_found, id, [&] { service.get(id); });
  EXPECT_TRUE(service.deleted().empty()) << "it left no folder";
}

TEST_F(SessionRemovalTest, NeitherPlaceIsEverOverwritten) {
  put("abcd");
  service.remove("abcd");
  put("abcd", {{"title", "another"}});
  expect_error(ErrorKind::conflict, "by now", [&] { SessionTrash(sessions).give_back("abcd"); });
  expect_error(ErrorKind::conflict, "deleted before", [&] { service.remove("abcd"); });
  EXPECT_EQ(service.get("abcd").request.title, "another");
  service.erase("abcd");
  service.remove("abcd");
  EXPECT_EQ(service.deleted().front().record->request.title, "another");
}

TEST_F(SessionRemovalTest, AServerThatWasEndedMeanwhileLeavesOneOrTheOther) {
  put("noted");  // ended between the note and the move
  folder.write("sessions/noted/deleted.json", R"({"deleted_utc": "2026-01-31T12:00:00Z"})");
  folder.write("trash/.erased-gone-abc/recording.ream", "half gone");
  folder.write("trash/unnoted/session.json", R"({"case": "demo", "script": "demo"})");
  const SessionService again(engine, {3, 2}, sessions, database);
  EXPECT_EQ(again.get("noted").status.state, SessionState::finished);
  EXPECT_FALSE(fs::exists(folder.path() / "trash/.erased-gone-abc"));
  ASSERT_EQ(again.deleted().size(), 1u);
  EXPECT_EQ(again.deleted().front().id, "unnoted");
  EXPECT_NO_THROW(utc_moment(again.deleted().front().deleted_utc));
}

TEST_F(SessionRemovalTest, OfManyAtOnceOneDeletes) {
  put("abcd");
  std::atomic<int> done{0}, refused{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 6; ++i)
    threads.emplace_back([&] {
      try {
        service.remove("abcd");
        ++done;
      } catch (const Error& error) {
        refused += error.kind() == ErrorKind::not_found ? 1 : 0;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(done, 1);
  EXPECT_EQ(refused, 5);
}

/// To destroy it would wait for its loop, and end the process with all other sessions.
TEST_F(SessionRemovalTest, OneWhoseLoopStandsStillIsHeldToTheEnd) {
  const int alive = test::FakeSession::alive();
  {
    test::FakeEngine its_engine;
    store::Database its_database{"sqlite:" + (folder.path() / "other.db").string()};
    SessionService its_service(its_engine, {3, 0}, folder.path() / "others", its_database);
    const std::string id = its_service.create({{}, "demo", "demo", {}}).request.id;
    its_engine.made(0).stand_still(true);
    its_service.stop(id);
    its_service.create({{}, "demo", "demo", {}});
    EXPECT_NO_THROW(its_service.get(id)) << "no surplus";
    its_service.remove(id);
    expect_error(ErrorKind::not_found, id, [&] { its_service.get(id); });
    EXPECT_EQ(test::FakeSession::alive(), alive + 2);
  }
  EXPECT_EQ(test::FakeSession::alive(), alive);
}

}  // namespace
}  // namespace ream::session
