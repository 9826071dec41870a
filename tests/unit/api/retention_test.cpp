#include "api/retention.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "support/fake_engine.hpp"
#include "support/hand_clock.hpp"
#include "support/temporary_folder.hpp"

namespace ream::api {
namespace {

namespace fs = std::filesystem;

class RetentionTest : public testing::Test {
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
    RetentionRules rules{keep_sessions_days, keep_deleted_days, std::chrono::milliseconds(1), {}};
    std::atomic<int> asked{0};
    rules.now = [&asked, later] {
      ++asked;
      return machine_clock()() + later;
    };
    Retention retention(
        rules, {service, replays, jobs, *feed, [](const std::string& study) { return study == "over"; },
                [this](const std::string& action, const std::string& id, const std::string&) {
                  audited.push_back(action + " " + id);
                }});
    retention.begin();
    while (asked < 8) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    retention.stop();
  }

  const test::TemporaryFolder folder;
  test::FakeEngine engine;
  session::SessionService service{engine, {3, 2}, folder.path() / "sessions"};
  session::ReplayService replays{engine, {}};
  jobs::JobService jobs;
  const std::shared_ptr<ChangeFeed> feed = std::make_shared<ChangeFeed>(may_know);
  std::vector<std::string> audited;
};

TEST_F(RetentionTest, WithoutRulesSessionsStayForEver) {
  put("ancient", 3000);
  look(std::nullopt, 30);
  EXPECT_TRUE(is_there("ancient"));
  EXPECT_TRUE(audited.empty());
}

TEST_F(RetentionTest, OldSessionsGoToTheTrashOnceAndAreAudited) {
  put("old", 31);
  put("young", 29);
  look(30, 10);
  EXPECT_TRUE(is_in_trash("old"));
  EXPECT_TRUE(is_there("young"));
  EXPECT_EQ(audited, std::vector<std::string>{"session.delete old"});
}

TEST_F(RetentionTest, WhatIsKeptLiveInUseOrOfAStudyThatIsNotOverStays) {
  put("kept", 100, {{"keep", true}});
  put("open", 100, {{"study", "open"}});
  put("over", 100, {{"study", "over"}});
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
  EXPECT_EQ(audited, std::vector<std::string>{"session.erase gone"});
}

TEST_F(RetentionTest, ManyPagesOfOldSessionsGoAtOnce) {
  for (int i = 0; i < 450; ++i) put("s" + std::to_string(i), 31 + i % 7);
  look(30, 0);
  EXPECT_TRUE(fs::is_empty(folder.path() / "sessions"));
  EXPECT_TRUE(fs::is_empty(folder.path() / "trash"));
  EXPECT_EQ(audited.size(), 900u);
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
  Retention retention({}, {service, replays, with_files, *feed, [](const std::string&) { return false; },
                           [](const std::string&, const std::string&, const std::string&) {}});
  retention.begin();
  while (with_files.get(id).result) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_TRUE(fs::is_empty(folder.path() / "jobs") || !fs::exists(folder.path() / "jobs" / id));
}

}  // namespace
}  // namespace ream::api
