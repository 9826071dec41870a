#include "api/retention.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "support/fake_engine.hpp"
#include "support/hand_clock.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_databases.hpp"

namespace ream::api {
namespace {

namespace fs = std::filesystem;

/// A server that has every case, and no users or sessions.
struct EveryCase final : study::StudyDependencies {
  std::optional<study::StudyUser> find_user(const std::string&) const override { return std::nullopt; }
  bool has_case(const std::string&) const override { return true; }
  bool has_live_session(const std::string&, const std::string&) const override { return false; }
  std::vector<session::SessionRecord> sessions(const std::string&) const override { return {}; }
  nlohmann::json metrics(const std::string&) const override { return nlohmann::json::object(); }
};

class RetentionTest : public test::TestDatabase<test::OnSqlite> {
 protected:
  void put(const std::string& id, int days_old, const nlohmann::json& more = nlohmann::json::object()) const {
    nlohmann::json session = {{"case", "demo"}, {"script", "demo"}, {"state", "finished"}};
    session["created_utc"] = utc_text(machine_clock()() - std::chrono::hours(24 * days_old + 1));
    session.update(more);
    folder.write("sessions/" + id + "/session.json", session.dump());
  }
  bool is_there(const std::string& id) const { return fs::exists(folder.path() / "sessions" / id); }
  bool is_in_trash(const std::string& id) const { return fs::exists(folder.path() / "trash" / id); }

  /// Begins, waits until it has looked, and ends.
  void look(std::optional<int> keep_sessions_days, int keep_deleted_days,
            std::chrono::hours later = std::chrono::hours(0)) {
    rules.keep_sessions_days = keep_sessions_days;
    rules.keep_deleted_days = keep_deleted_days;
    ahead = later;
    Retention retention(rules, tools());
    retention.begin();
    look_again();
    held = retention.held();
    retention.stop();
  }
  /// Waits until a look that began after now is over. A look asks once for the time.
  void look_again() {
    const int before = asked;
    while (asked < before + 2) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  RetentionTools tools() { return {service, replays, jobs, answers, *feed, studies, audit_log}; }

  /// Actions and ids, the first one first.
  std::vector<std::string> audited() const {
    std::vector<std::string> rows;
    for (const store::AuditRow& row : audit_log.list(INT64_MAX, 10'000))
      rows.insert(rows.begin(), row.action + " " + row.object);
    return rows;
  }
  std::string make_study() { return studies.create({"A study", "", {{"demo"}, "", "", ""}, {}}).id; }

  const test::TemporaryFolder folder;
  test::FakeEngine engine;
  session::SessionService service{engine, {3, 2}, folder.path() / "sessions", database()};
  session::ReplayService replays{engine, {}};
  jobs::JobService jobs;
  Idempotency answers{database(), [] { return UtcMoment(); }};
  std::atomic<int> asked{0};
  std::atomic<std::chrono::hours> ahead{std::chrono::hours(0)};
  std::string held;
  RetentionRules rules = [this] {
    RetentionRules made;
    made.look_every = std::chrono::milliseconds(1);
    made.now = [this] {
      ++asked;
      return machine_clock()() + ahead.load();
    };
    return made;
  }();
  const std::shared_ptr<ChangeFeed> feed = std::make_shared<ChangeFeed>();
  access::AuditLog audit_log{database(), machine_clock()};
  study::StudyService studies{database(), std::make_unique<EveryCase>()};
};

TEST_F(RetentionTest, WithoutRulesSessionsStayForEver) {
  put("ancient", 3000);
  look(std::nullopt, 30);
  EXPECT_TRUE(is_there("ancient"));
  EXPECT_TRUE(audited().empty());
}

TEST_F(RetentionTest, OldSessionsGoToTheTrashOnceAndAreAudited) {
  put("old", 31);
  put("young", 29);
  look(30, 10);
  EXPECT_TRUE(is_in_trash("old"));
  EXPECT_TRUE(is_there("young"));
  EXPECT_EQ(audited(), std::vector<std::string>{"session.delete old"});
}

TEST_F(RetentionTest, WhatIsKeptLiveInUseOrOfAStudyThatIsNotOverStays) {
  put("kept", 100, {{"keep", true}});
  const std::string over = make_study();
  studies.close(over);
  put("open", 100, {{"study", make_study()}});
  put("over", 100, {{"study", over}});
  put("used", 100);
  const auto lock = FileLock::attempt(session::lock_file(folder.path() / "sessions/used"));
  const std::string live = service.create({{}, "demo", "demo", {}}).request.id;
  look(30, 10, std::chrono::hours(24 * 300));
  for (const char* id : {"kept", "open", "used"}) EXPECT_TRUE(is_there(id)) << id;
  EXPECT_TRUE(is_in_trash("over") || !is_there("over"));
  EXPECT_NO_THROW(service.get(live));
}

TEST_F(RetentionTest, TheTrashIsEmptiedInTime) {
  put("gone", 1);
  service.remove("gone");
  look(std::nullopt, 30, std::chrono::hours(24 * 30 - 1));
  EXPECT_TRUE(is_in_trash("gone"));
  look(std::nullopt, 30, std::chrono::hours(24 * 30 + 1));
  EXPECT_FALSE(is_in_trash("gone"));
  EXPECT_EQ(audited(), std::vector<std::string>{"session.erase gone"});
}

TEST_F(RetentionTest, ManyPagesOfOldSessionsGoAtOnce) {
  for (int i = 0; i < 450; ++i) put("s" + std::to_string(i), 31 + i % 7);
  rules.max_at_once_percent = 100;
  look(30, 0);
  EXPECT_TRUE(fs::is_empty(folder.path() / "sessions"));
  EXPECT_TRUE(fs::is_empty(folder.path() / "trash"));
  EXPECT_EQ(audited().size(), 900u);
}

TEST_F(RetentionTest, NothingGoesWhenTooMuchWouldGoAtOnce) {
  for (int i = 0; i < 30; ++i) put("s" + std::to_string(i), 10);
  look(30, 10, std::chrono::hours(24 * 365));
  EXPECT_TRUE(is_there("s0")) << "a clock that is a year ahead at the start";
  EXPECT_NE(held.find("30 of 30 sessions"), std::string::npos) << held;
  for (int i = 0; i < 30; ++i) service.remove("s" + std::to_string(i));
  look(std::nullopt, 30, std::chrono::hours(24 * 365));
  EXPECT_TRUE(is_in_trash("s0"));
  EXPECT_NE(held.find("30 of 30"), std::string::npos) << held;
  rules.max_at_once_percent = 100;
  look(std::nullopt, 30, std::chrono::hours(24 * 365));
  EXPECT_FALSE(is_in_trash("s0"));
  EXPECT_EQ(held, "");
}

class RetentionOverRuns : public RetentionTest {
 protected:
  RetentionOverRuns() {
    rules.clock_file = folder.path() / "clock.json";
    rules.keep_sessions_days = 30;
    rules.running = [this] { return std::chrono::nanoseconds(on.load()); };
    rules.now = [this] {
      ++asked;
      return machine_clock()() + on.load() + ahead.load();
    };
  }
  /// A run of so many hours.
  void run(std::chrono::hours hours) {
    Retention retention(rules, tools());
    retention.begin();
    look_again();
    on = on.load() + hours;
    look_again();
    held = retention.held();
    retention.stop();
  }
  std::atomic<std::chrono::hours> on{std::chrono::hours(0)};
};

TEST_F(RetentionOverRuns, AClockThatIsAheadAtAStartErasesNothing) {
  put("old", 20);
  run(std::chrono::hours(1));
  EXPECT_EQ(held, "");
  // Neither by one start nor by the next one, nor when it is set back.
  ahead = std::chrono::hours(24 * 365);
  for (int start = 0; start < 3; ++start) {
    run(std::chrono::hours(1));
    EXPECT_TRUE(is_there("old"));
    EXPECT_NE(held, "") << start;
  }
  ahead = std::chrono::hours(0);
  run(std::chrono::hours(1));
  EXPECT_NE(held.find("the server last ran at"), std::string::npos) << held;
}

TEST_F(RetentionOverRuns, AMachineThatIsSwitchedOffAtNightDoesItsWork) {
  put("old", 20);
  run(std::chrono::hours(1));
  ahead = std::chrono::hours(24 * 20);  // off for twenty days
  for (int day = 0; day < 2; ++day) {
    run(std::chrono::hours(9));
    EXPECT_TRUE(is_there("old")) << day;
    ahead = ahead.load() + std::chrono::hours(15);
  }
  run(std::chrono::hours(9));
  run(std::chrono::hours(1));
  EXPECT_FALSE(is_there("old"));
  EXPECT_EQ(held, "");
}

TEST_F(RetentionTest, WhatKeepsTheClockMayBeDamaged) {
  rules.clock_file = folder.write("clock.json", "{");
  put("old", 40);
  look(30, 10);
  EXPECT_TRUE(is_there("old"));
  EXPECT_NE(held.find("clock.json"), std::string::npos) << held;
}

TEST_F(RetentionTest, NothingGoesForADayAfterTheClockWasMoved) {
  std::atomic<std::chrono::hours> on{std::chrono::hours(0)}, moved{std::chrono::hours(0)};
  rules.running = [&] { return std::chrono::nanoseconds(on.load()); };
  rules.now = [&] {
    ++asked;
    return machine_clock()() + on.load() + moved.load();
  };
  rules.keep_sessions_days = 30;
  put("old", 20);
  Retention retention(rules, tools());
  retention.begin();
  look_again();
  moved = std::chrono::hours(24 * 11);
  look_again();
  EXPECT_TRUE(is_there("old"));
  EXPECT_NE(retention.held().find("was moved by"), std::string::npos) << retention.held();
  on = std::chrono::hours(23);
  look_again();
  EXPECT_TRUE(is_there("old"));
  while (is_there("old")) {
    on = on.load() + std::chrono::hours(24);
    look_again();
  }
  EXPECT_TRUE(is_in_trash("old"));
  retention.stop();
}

TEST_F(RetentionTest, WhatIsNotToBeKeptIsErasedWhateverTheClockSays) {
  put("gone", 1);
  service.remove("gone");
  look(std::nullopt, 0, -std::chrono::hours(24 * 365));
  EXPECT_FALSE(is_in_trash("gone"));
}

TEST_F(RetentionTest, AnswersToRepeatGoWithTheirSessionAndWithTime) {
  Idempotency of_today(database());
  store::IdempotencyTable table(database());
  const auto put_answer = [&](const std::string& key, const std::string& body, const std::string& at_utc) {
    table.put({"u1", key, "print", 201, "application/json", "", body,
               utc_moment(at_utc).time_since_epoch() / std::chrono::milliseconds(1)});
  };
  put("gone", 1);
  service.remove("gone");
  const std::string now = utc_text(machine_clock()()), long_ago = "2020-01-01T00:00:00Z";
  put_answer("of it", R"({"id": "gone", "trainee": "Tina"})", now);
  put_answer("of another", R"({"id": "other"})", now);
  put_answer("old", "{}", long_ago);
  rules.keep_deleted_days = 0;
  Retention retention(rules, {service, replays, jobs, of_today, *feed, studies, audit_log});
  retention.begin();
  look_again();
  retention.stop();
  EXPECT_FALSE(table.find("u1", "of it"));
  EXPECT_TRUE(table.find("u1", "of another"));
  EXPECT_FALSE(table.find("u1", "old"));
}

TEST_F(RetentionTest, OldFilesOfJobsGoToo) {
  std::atomic<UtcMoment> now{machine_clock()()};
  jobs::JobService with_files(
      {folder.path() / "jobs", std::chrono::hours(24), 8, {}, [&] { return now.load(); }});
  const std::string id = with_files
                             .submit_file({"export", {}, "abcd"},
                                          [](const fs::path& place, const Progress&) {
                                            std::ofstream(place / "a.csv") << "a";
                                            return jobs::JobService::MadeFile{"a.csv", "text/csv"};
                                          })
                             .id;
  while (jobs::is_open(with_files.get(id).state)) std::this_thread::yield();
  now = now.load() + std::chrono::hours(25);
  Retention retention({}, {service, replays, with_files, answers, *feed, studies, audit_log});
  retention.begin();
  while (with_files.get(id).result) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_TRUE(fs::is_empty(folder.path() / "jobs") || !fs::exists(folder.path() / "jobs" / id));
}

}  // namespace
}  // namespace ream::api
