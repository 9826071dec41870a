#include "access_fixture.hpp"
#include "core/file.hpp"

namespace ream::test {
namespace {

using access::Role;
namespace fs = std::filesystem;

class DeletionContractTest : public AccessTest {
 protected:
  void SetUp() override {
    for (const char* id : {"first", "second", "third"}) put_session(id);
  }
  void put_session(const std::string& id, const json& more = json::object()) const {
    json session = {{"case", "planned"},
                    {"script", "demo"},
                    {"state", "stopped"},
                    {"created_utc", "2026-01-31T12:00:00Z"}};
    session.update(more);
    folder.write("sessions/" + id + "/session.json", session.dump());
    folder.write("sessions/" + id + "/recording.ream", "0123456789");
  }
  bool is_listed(const std::string& id) { return get(all).body.find("\"" + id + "\"") != std::string::npos; }
  bool is_in_trash(const std::string& id) const { return fs::exists(folder.path() / "trash" / id); }

  const std::string trash = "/api/v1/trash";
};

TEST_F(DeletionContractTest, EveryDescribedReplyIsGivenAsDescribed) {
  start();
  const std::string live = create(), pattern = one + "/restore", path = all + "/first";
  expect_request("DELETE", one, all + "/" + live, 409);
  expect_request("DELETE", one, all + "/nobody", 404);
  expect_request("DELETE", one, path, 403, "", foreign);
  EXPECT_TRUE(is_listed("first"));
  expect_request("DELETE", one, path, 204);
  expect_request("DELETE", one, path, 404);
  expect_get(one, path, 404);
  EXPECT_FALSE(is_listed("first"));
  expect_request("DELETE", one, all + "/second", 204);

  expect_get(trash, trash, 200);
  expect_get(trash, trash + "?sort=deleted_utc&limit=1", 200);
  expect_get(trash, trash + "?sort=id", 422);
  const json deleted = json::parse(get(trash + "?limit=1").body);
  EXPECT_EQ(deleted.at("total"), 2);
  EXPECT_EQ(
      json::parse(get(trash + "?cursor=" + deleted.at("next").get<std::string>()).body).at("deleted").size(),
      1u);
  EXPECT_EQ(deleted.at("deleted").at(0).at("session").at("case"), "planned");

  expect_post(pattern, path + "/restore", 403, "", foreign);
  expect_post(pattern, path + "/restore", 200);
  EXPECT_TRUE(is_listed("first"));
  expect_get(one, path, 200);
  expect_post(pattern, path + "/restore", 409);
  expect_post(pattern, all + "/nobody/restore", 404);
  EXPECT_EQ(json::parse(get(trash).body).at("total"), 1);
  expect_all_given({"deletion"});
}

TEST_F(DeletionContractTest, WhatCannotBeReadIsListedAsSuch) {
  folder.write("trash/damaged/session.json", "{");
  folder.write("trash/damaged/deleted.json", "{");
  start();
  expect_get("/api/v1/trash", trash, 200);
  const json deleted = json::parse(get(trash).body).at("deleted");
  ASSERT_EQ(deleted.size(), 1u);
  EXPECT_EQ(deleted.at(0).at("id"), "damaged");
  EXPECT_TRUE(deleted.at(0).at("session").is_null());
}

TEST_F(DeletionContractTest, ATraineeDeletesTheirOwnButNoneOfAStudy) {
  start();
  const Sent operator_ = token_of(add_user("olga", Role::operator_));
  const std::string tom_id = add_user("tom", Role::trainee);
  const Sent tom = token_of(tom_id), tess = token_of(add_user("tess", Role::trainee));
  put_session("toms", {{"trainee_id", tom_id}, {"trainee", "Tom"}});
  put_session("studied", {{"trainee_id", tom_id}, {"study", "glenoids"}, {"participant", "K7-F3M"}});
  EXPECT_EQ(request("DELETE", all + "/first", tom).status, 404);
  EXPECT_EQ(request("DELETE", all + "/toms", tess).status, 404);
  EXPECT_EQ(request("DELETE", all + "/studied", tom).status, 403);
  EXPECT_EQ(request("DELETE", all + "/toms", tom).status, 204);
  EXPECT_TRUE(is_in_trash("toms"));
  EXPECT_EQ(request("POST", all + "/toms/restore", tom).status, 403);
  EXPECT_EQ(request("GET", trash, tom).status, 403);
  EXPECT_EQ(request("POST", all + "/toms/restore", operator_).status, 200);
  EXPECT_EQ(request("DELETE", all + "/studied", operator_).status, 204);
  std::vector<std::string> actions;
  for (const auto& row : access_control().audit.list(INT64_MAX, 3))
    actions.push_back(row.action + " " + row.object);
  EXPECT_EQ(actions, (std::vector<std::string>{"session.delete studied", "session.restore toms",
                                               "session.delete toms"}));
}

TEST_F(DeletionContractTest, WhoWatchesIsToldAndReplaysEnd) {
  start();
  RawWebSocket listener(server->port(), "/api/v1/events");
  const auto next_of = [&](const std::string& id) {
    for (;;)
      if (const json told = json::parse(listener.receive().payload); told.value("id", "") == id)
        return told.at("change").get<std::string>();
  };
  EXPECT_EQ(listener.receive().opcode, 1);
  const json replay = json::parse(post(all + "/first/replay").body);
  const std::string replay_id = replay.at("id");
  EXPECT_EQ(http_request(server->port(), "DELETE", all + "/" + replay_id).status, 409);
  http_request(server->port(), "DELETE", all + "/first");
  EXPECT_EQ(next_of("first"), "deleted");
  EXPECT_EQ(get(all + "/" + replay_id).status, 404);
  post(all + "/first/restore");
  EXPECT_EQ(next_of("first"), "restored");
}

TEST_F(DeletionContractTest, ByTheRulesOldSessionsGoAndThoseOfAnOpenStudyStay) {
  start();
  const Sent olga = token_of(add_user("olga", Role::operator_));
  const json study = json::parse(
      request("POST", "/api/v1/studies", olga, R"({"name": "Glenoids", "cases": ["planned"]})").body);
  const std::string study_id = study.at("id");
  for (const char* id : {"studied", "unknown"})
    put_session(id, {{"study", id[0] == 's' ? study_id : "lost"}, {"participant", "K7-F3M"}});
  put_session("kept", {{"keep", true}});
  const auto begin_again = [&] {
    server.reset();
    options.retention.keep_sessions_days = 30;
    options.retention.keep_deleted_days = 0;
    start();
  };
  begin_again();
  const auto is_there = [&](const std::string& id) { return fs::exists(options.sessions_folder / id); };
  const auto wait_until_erased = [&](const std::string& id) {
    const std::string action = "session.erase";
    for (;;)
      for (const auto& row : access_control().audit.list(INT64_MAX, 100))
        if (row.action == action && row.object == id) return row;
  };
  for (const char* id : {"first", "second", "third"}) EXPECT_EQ(wait_until_erased(id).name, "retention");
  for (const char* id : {"first", "second", "third"}) EXPECT_FALSE(is_there(id) || is_in_trash(id)) << id;
  for (const char* id : {"studied", "unknown", "kept"}) EXPECT_TRUE(is_there(id)) << id;

  EXPECT_EQ(request("POST", "/api/v1/studies/" + study_id + "/close", olga).status, 200);
  begin_again();
  wait_until_erased("studied");
  EXPECT_FALSE(is_there("studied"));
  for (const char* id : {"unknown", "kept"}) EXPECT_TRUE(is_there(id)) << id;

  put_session("newer", {{"created_utc", utc_text(machine_clock()())}});
  EXPECT_EQ(request("DELETE", all + "/newer", olga).status, 204);
  wait_until_erased("newer");
  EXPECT_FALSE(is_in_trash("newer"));
}

}  // namespace
}  // namespace ream::test
