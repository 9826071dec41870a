#include "session/folder/session_register.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "core/file.hpp"
#include "core/file_lock.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"
#include "support/test_databases.hpp"

namespace ream::session {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A folder of sessions.
class Sessions {
 public:
  void put(const std::string& id, const std::string& utc, const std::string& state,
           json more = json::object()) const {
    json session = {
        {"case", "demo"}, {"script", "demo"}, {"created_utc", utc}, {"state", state}, {"ticks", 1250}};
    session.update(more);
    fs::create_directories(folder.path() / id);
    write_file_atomically(folder.path() / id / "session.json", session.dump());
  }
  void remove(const std::string& id) const { fs::remove_all(folder.path() / id); }

  const test::TemporaryFolder folder;
  const SessionArchive archive{folder.path()};
};

SessionRecord live(const std::string& id, const std::string& utc) {
  SessionRecord record;
  record.request.id = id;
  record.request.case_id = "demo";
  record.request.created_utc = utc;
  record.status.state = SessionState::running;
  return record;
}

using Ids = std::vector<std::string>;

Ids ids_of(const SessionPage& page) {
  Ids ids;
  for (const SessionRecord& record : page.sessions) ids.push_back(record.request.id);
  return ids;
}

template <typename Store>
class SessionRegisterTest : public testing::Test {
 protected:
  void begin() { register_ = std::make_unique<SessionRegister>(sessions.archive, database); }
  SessionPage page(const store::SessionQuery& query = {}, std::vector<SessionRecord> held = {}) {
    if (!register_) begin();
    return register_->list(query, std::move(held));
  }
  Ids listed(const store::SessionQuery& query = {}, std::vector<SessionRecord> held = {}) {
    return ids_of(page(query, std::move(held)));
  }
  void end() { register_.reset(); }

  const Sessions sessions{};
  const Store store{};
  store::Database database{store.url};
  std::unique_ptr<SessionRegister> register_;
};
TYPED_TEST_SUITE(SessionRegisterTest, test::BothStores, test::StoreNames);

TYPED_TEST(SessionRegisterTest, TellsWhatTheFoldersSay) {
  this->sessions.put("older", "2025-03-01T12:00:00Z", "fault",
                     {{"fault", "the device fell silent"}, {"force_scale", 13.0}});
  this->sessions.put("newest", "2025-03-03T12:00:00Z", "stopped");
  this->sessions.put("middle", "2025-03-02T12:00:00Z", "finished", {{"case", "left"}});
  for (int start = 0; start < 2; ++start) {
    EXPECT_EQ(this->listed(), (Ids{"newest", "middle", "older"}));
    const SessionRecord record = this->page().sessions.back();
    EXPECT_EQ(record.status.state, SessionState::fault);
    EXPECT_EQ(record.status.fault, "the device fell silent");
    EXPECT_EQ(record.status.force_scale, 13.0);
    EXPECT_DOUBLE_EQ(record.status.duration_s, 1.25);
    EXPECT_FALSE(record.streamable);
    store::SessionQuery query;
    query.case_id = "left";
    EXPECT_EQ(this->listed(query), Ids{"middle"});
    this->end();  // and the same again with an index that is there already
  }
}

TYPED_TEST(SessionRegisterTest, NoticesWhatChangesWithoutAWord) {
  this->sessions.put("aaaa", "2025-03-01T12:00:00Z", "finished");
  EXPECT_EQ(this->listed(), Ids{"aaaa"});
  this->sessions.put("bbbb", "2025-03-02T12:00:00Z", "finished");
  EXPECT_EQ(this->listed(), (Ids{"bbbb", "aaaa"}));
  this->sessions.remove("aaaa");
  EXPECT_EQ(this->listed(), Ids{"bbbb"});
  this->sessions.folder.write("cccc/other.txt", "");
  EXPECT_EQ(this->listed(), Ids{"bbbb"});
  this->sessions.put("cccc", "2025-03-03T12:00:00Z", "finished");
  EXPECT_EQ(this->listed(), (Ids{"cccc", "bbbb"}));
}

TYPED_TEST(SessionRegisterTest, TellsTheMarkOfAScoreThatCanBeRead) {
  const auto mark = [&](const std::string& id, const json& score) {
    write_file_atomically(this->sessions.folder.path() / id / "score.json", score.dump());
  };
  const json good = {{"points", 81.5}, {"outcome", "pass"}, {"rubric", "Standard"}, {"version", 3}};
  for (const char* id : {"good", "odd", "none"}) this->sessions.put(id, "2025-03-01T12:00:00Z", "finished");
  this->sessions.put("running", "2025-03-01T12:00:00Z", "running");
  const auto lock = FileLock::attempt(this->sessions.folder.path() / "running" / "lock");
  mark("good", {{"score", good}});
  mark("running", {{"score", good}});
  mark("odd", {{"score", {{"points", "many"}, {"outcome", 1}, {"rubric", json()}, {"version", "x"}}}});
  store::SessionQuery query;
  query.order = store::SessionOrder::points;
  for (int start = 0; start < 2; ++start) {
    const auto listed = this->page(query).sessions;
    ASSERT_EQ(listed.size(), 4u);
    EXPECT_EQ(listed[0].request.id, "good");
    ASSERT_TRUE(listed[0].mark);
    EXPECT_EQ(listed[0].mark->points, 81.5);
    EXPECT_EQ(listed[0].mark->outcome, "pass");
    EXPECT_EQ(listed[0].mark->version, 3);
    for (size_t i = 1; i < 4; ++i) EXPECT_FALSE(listed[i].mark) << listed[i].request.id;
    this->end();
  }
  json better = good;
  better["points"] = 90.0;
  mark("good", {{"score", better}});  // while no server runs, and then while one does
  EXPECT_EQ(this->page(query).sessions[0].mark->points, 90.0);
  mark("none", {{"score", good}});
  this->register_->changed("none");
  EXPECT_EQ(this->listed(query).at(1), "none");
}

TYPED_TEST(SessionRegisterTest, NoticesAtTheStartWhatChangedMeanwhile) {
  for (const char* id : {"aaaa", "bbbb", "cccc"}) this->sessions.put(id, "2025-03-01T12:00:00Z", "finished");
  EXPECT_EQ(this->listed().size(), 3u);
  this->end();
  this->sessions.remove("aaaa");
  this->sessions.put("bbbb", "2025-03-01T12:00:00Z", "stopped");
  this->sessions.put("dddd", "2025-03-01T12:00:00Z", "finished");
  store::SessionQuery query;
  query.states = {"finished"};
  EXPECT_EQ(this->listed(query), (Ids{"dddd", "cccc"}));
  EXPECT_EQ(this->listed(), (Ids{"dddd", "cccc", "bbbb"}));
}

TYPED_TEST(SessionRegisterTest, AChangeThatIsToldCountsAtOnce) {
  this->sessions.put("aaaa", "2025-03-01T12:00:00Z", "finished");
  this->sessions.put("bbbb", "2025-03-01T12:00:00Z", "finished");
  EXPECT_EQ(this->listed().size(), 2u);
  for (int round = 0; round < 20; ++round) {
    const std::string name = "case" + std::to_string(round);
    this->sessions.put("aaaa", "2025-03-01T12:00:00Z", "finished", {{"case", name}});
    this->register_->changed("aaaa");
    store::SessionQuery query;
    query.case_id = name;
    ASSERT_EQ(this->listed(query), Ids{"aaaa"});
  }
}

TYPED_TEST(SessionRegisterTest, WhatIsInMemoryCountsAsItIsNow) {
  this->sessions.put("aaaa", "2025-03-01T12:00:00Z", "finished");
  this->sessions.put("bbbb", "2025-03-02T12:00:00Z", "stopped");
  const std::vector<SessionRecord> held{live("bbbb", "2025-03-02T12:00:00Z"),
                                        live("nofolder", "2025-03-03T12:00:00Z")};
  EXPECT_EQ(this->listed({}, held), (Ids{"nofolder", "bbbb", "aaaa"}));
  store::SessionQuery query;
  query.states = {"running"};
  const SessionPage running = this->page(query, held);
  EXPECT_EQ(ids_of(running), (Ids{"nofolder", "bbbb"}));
  EXPECT_EQ(running.total, 2u);
  query.states = {"stopped"};
  EXPECT_EQ(this->listed(query, held), Ids{});
  EXPECT_EQ(this->listed(query), Ids{"bbbb"});
}

TYPED_TEST(SessionRegisterTest, PagesHoldEverySessionOnce) {
  std::mt19937 random(test::seed());
  const auto pick = [&](int below) { return std::uniform_int_distribution<int>(0, below - 1)(random); };
  std::vector<SessionRecord> held;
  for (int i = 0; i < 60; ++i) {
    const std::string id = "s" + std::to_string(i * 37 % 60),
                      utc = "2025-03-0" + std::to_string(1 + pick(3)) + "T12:00:00Z";
    if (pick(5) == 0) held.push_back(live(id, utc));
    if (held.empty() || held.back().request.id != id || pick(2) == 0)
      this->sessions.put(id, utc, pick(2) == 0 ? "finished" : "stopped", {{"ticks", 1000 * pick(3)}});
  }
  for (const char* order : {"created_utc", "duration_s", "case", "trainee", "state"})
    for (const bool descending : {true, false}) {
      store::SessionQuery query;
      query.order = store::session_order_from(order).value();
      query.descending = descending;
      query.limit = SIZE_MAX;
      const Ids whole = this->listed(query, held);
      EXPECT_EQ(whole.size(), 60u);
      query.limit = static_cast<size_t>(1 + pick(20));
      Ids paged;
      do {
        const SessionPage page = this->page(query, held);
        EXPECT_EQ(page.total, 60u);
        for (const std::string& id : ids_of(page)) paged.push_back(id);
        query.cursor = page.next;
      } while (!query.cursor.empty());
      EXPECT_EQ(paged, whole) << order;
    }
}

TYPED_TEST(SessionRegisterTest, OfNoRowsTellsTheNumberOnly) {
  this->sessions.put("aaaa", "2025-03-01T12:00:00Z", "finished");
  store::SessionQuery query;
  query.limit = 0;
  const SessionPage page = this->page(query);
  EXPECT_TRUE(page.sessions.empty());
  EXPECT_EQ(page.next, "");
  EXPECT_EQ(page.total, 1u);
}

TYPED_TEST(SessionRegisterTest, DamagedFoldersAreLeftOutUntilTheyAreRepaired) {
  this->sessions.put("aaaa", "2025-03-01T12:00:00Z", "finished");
  this->sessions.put("bbbb", "2025-03-01T12:00:00Z", "asleep");
  this->sessions.folder.write("cccc/session.json", "{");
  EXPECT_EQ(this->listed(), Ids{"aaaa"});
  this->sessions.put("bbbb", "2025-03-01T12:00:00Z", "finished");
  EXPECT_EQ(this->listed(), (Ids{"bbbb", "aaaa"}));
}

TYPED_TEST(SessionRegisterTest, ALiveStateCountsWhileItsLockIsHeldOnly) {
  this->sessions.put("aaaa", "2025-03-01T12:00:00Z", "running");
  store::SessionQuery running;
  running.states = {"running"};
  {
    const auto lock = FileLock::attempt(lock_file(this->sessions.folder.path() / "aaaa"));
    ASSERT_TRUE(lock);
    EXPECT_EQ(this->listed(running), Ids{"aaaa"});
    this->end();
    EXPECT_EQ(this->listed(running), Ids{"aaaa"});
  }
  EXPECT_EQ(this->listed(running), Ids{});
  EXPECT_EQ(this->page().sessions.at(0).status.state, SessionState::interrupted);
  this->sessions.put("aaaa", "2025-03-01T12:00:00Z", "finished");
  EXPECT_EQ(this->page().sessions.at(0).status.state, SessionState::finished);
}

TYPED_TEST(SessionRegisterTest, ANameWithAZeroByteIsListed) {
  this->sessions.put("aaaa", "2025-03-01T12:00:00Z", "finished", {{"fault", std::string("a\0b", 3)}});
  EXPECT_EQ(this->page().sessions.at(0).status.fault, std::string("a\0b", 3));
}

template <typename Store>
class SessionIndexUpkeepTest : public SessionRegisterTest<Store> {};
TYPED_TEST_SUITE(SessionIndexUpkeepTest, test::BothStores, test::StoreNames);

TYPED_TEST(SessionIndexUpkeepTest, ADamagedIndexLosesNoSession) {
  for (const char* id : {"aaaa", "bbbb", "cccc"}) this->sessions.put(id, "2025-03-01T12:00:00Z", "finished");
  EXPECT_EQ(this->listed().size(), 3u);
  this->end();
  store::SessionIndex index(this->database);
  index.remove({"aaaa"});
  auto row = index.get("bbbb").value();
  row.record = "{";
  auto stranger = row;
  stranger.id = "dddd";
  index.put({row, stranger});
  EXPECT_EQ(this->listed(), (Ids{"cccc", "bbbb", "aaaa"}));
  this->end();
  EXPECT_EQ(index.get("bbbb")->record.front(), '{');
  EXPECT_GT(index.get("bbbb")->record.size(), 1u);
  EXPECT_EQ(index.marks().size(), 3u);
}

TYPED_TEST(SessionIndexUpkeepTest, IsMadeAnewWhenAsked) {
  for (const char* id : {"aaaa", "bbbb"}) this->sessions.put(id, "2025-03-01T12:00:00Z", "finished");
  EXPECT_EQ(this->listed().size(), 2u);
  this->end();
  store::SessionIndex index(this->database);
  auto row = index.get("bbbb").value();
  row.state = "fault";  // which the stamp does not tell
  index.put({row});
  EXPECT_EQ(rebuild_index(this->sessions.archive, this->database), 2u);
  EXPECT_EQ(index.get("bbbb")->state, "finished");
}

TYPED_TEST(SessionIndexUpkeepTest, ListsManyAtTheFirstStart) {
  const std::string text =
      R"({"case": "demo", "script": "demo", "created_utc": "2025-03-01T12:00:00Z", "state": "finished"})";
  for (int i = 0; i < 450; ++i) this->sessions.folder.write("s" + std::to_string(i) + "/session.json", text);
  const SessionPage page = this->page();
  EXPECT_EQ(page.total, 450u);
  EXPECT_EQ(page.sessions.size(), 50u);
}

TEST(SessionIndexOutage, ListsAreRefusedAndThenHoldEverything) {
  test::PostgresServer server;
  const Sessions sessions{};
  sessions.put("aaaa", "2025-03-01T12:00:00Z", "finished");
  store::Database database(server.make_database());
  SessionRegister all(sessions.archive, database);
  EXPECT_EQ(ids_of(all.list({}, {})), Ids{"aaaa"});
  server.stop();
  sessions.put("bbbb", "2025-03-02T12:00:00Z", "finished");
  all.changed("bbbb");
  for (int i = 0; i < 3; ++i)
    test::expect_error(ErrorKind::unavailable, database.name() + " does not answer",
                       [&] { all.list({}, {}); });
  for (int i = 0; i < 150; ++i) sessions.put("s" + std::to_string(i), "2025-03-01T12:00:00Z", "finished");
  test::expect_error(ErrorKind::unavailable, database.name() + " does not answer", [&] { all.list({}, {}); });
  server.start();
  const auto latest = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  for (size_t total = 0; total != 152;) {
    ASSERT_LT(std::chrono::steady_clock::now(), latest);
    try {
      total = all.list({}, {}).total;
    } catch (const Error& away) {
      EXPECT_EQ(away.kind(), ErrorKind::unavailable) << away.what();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
}

}  // namespace
}  // namespace ream::session
