// Places for live sessions, replays and jobs: nobody can take them all.
#include "device/script/script.hpp"
#include "session/service/simulation_engine.hpp"
#include "support/wait_until.hpp"
#include "wire/contract/access_fixture.hpp"

namespace ream::test {
namespace {

class LivePlacesTest : public AccessTest {
 protected:
  HttpReply make_session(const Sent& as) {
    return request("POST", "/api/v1/sessions", as, R"({"case": "planned", "script": "demo"})");
  }
};

TEST_F(LivePlacesTest, OneTraineeLeavesPlacesToOthers) {
  start();
  add_user("olga", access::Role::operator_);
  const Sent tom = token_of(add_user("tom", access::Role::trainee)),
             tess = token_of(add_user("tess", access::Role::trainee)),
             ina = token_of(add_user("ina", access::Role::instructor));
  const HttpReply first = make_session(tom);
  ASSERT_EQ(first.status, 201) << first.body;
  EXPECT_EQ(make_session(tom).status, 201);
  const HttpReply third = make_session(tom);
  expect_as_described("POST", "/api/v1/sessions", 409, third);
  EXPECT_NE(third.body.find("2 of your sessions are live"), std::string::npos) << third.body;
  EXPECT_EQ(make_session(tess).status, 201);
  EXPECT_EQ(make_session(ina).status, 201);
  expect_as_described("POST", "/api/v1/sessions", 503, make_session(ina));

  // A place that is given back can be had again.
  const std::string id = json::parse(first.body).at("id");
  EXPECT_EQ(request("POST", "/api/v1/sessions/" + id + "/stop", tom).status, 200);
  EXPECT_EQ(make_session(tom).status, 201);
}

class SharedPlacesTest : public AccessTest {
 protected:
  SharedPlacesTest() {
    options.data_folder = folder.path();
    start();
    add_user("olga", access::Role::operator_);
    tom_id = add_user("tom", access::Role::trainee);
    tom = token_of(tom_id);
    tess = token_of(add_user("tess", access::Role::trainee));
    ina_id = add_user("ina", access::Role::instructor);
    ina = token_of(ina_id);
    for (int i = 0; i < 20; ++i) {
      put_session("t" + std::to_string(i), tom_id);
      put_session("s" + std::to_string(i), access_control().users.find_by_name("tess")->id);
    }
  }
  ~SharedPlacesTest() override { engine->held = false; }
  void put_session(const std::string& id, const std::string& trainee_id) {
    folder.write("sessions/" + id + "/session.json", json{{"case", "planned"},
                                                          {"script", "demo"},
                                                          {"state", "stopped"},
                                                          {"ticks", 5000},
                                                          {"trainee_id", trainee_id}}
                                                         .dump());
    folder.write("sessions/" + id + "/recording.ream", "0123456789");
  }
  HttpReply replay(const std::string& id, const Sent& as) {
    return request("POST", all + "/" + id + "/replay", as);
  }
  HttpReply export_csv(const std::string& id, const Sent& as) {
    return request("POST", all + "/" + id + "/exports", as, R"({"format": "csv"})");
  }
  std::string tom_id, ina_id;
  Sent tom, tess, ina;
};

TEST_F(SharedPlacesTest, OneTraineesJobsLeavePlacesToOthers) {
  engine->held = true;
  for (int i = 0; i < 4; ++i) EXPECT_EQ(export_csv("t" + std::to_string(i), tom).status, 202) << i;
  const HttpReply fifth = export_csv("t4", tom);
  expect_as_described("POST", one + "/exports", 503, fifth);
  EXPECT_NE(fifth.body.find("4 jobs of yours wait or run"), std::string::npos) << fifth.body;
  for (const std::string made : {"mesh", "snapshot"})
    expect_as_described("GET", one + "/" + made, 503, request("GET", all + "/t5/" + made, tom));
  expect_as_described("GET", one + "/deviation", 503, request("GET", all + "/t5/deviation?to=plan", tom));
  EXPECT_EQ(export_csv("t4", token_of(tom_id)).status, 503) << "another token is the same trainee";
  EXPECT_EQ(export_csv("s0", tess).status, 202);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(export_csv("t1" + std::to_string(i), ina).status, 202) << i;

  // A place that is given back can be had again.
  engine->held = false;
  wait_until("tom's jobs to end", [&] { return export_csv("t4", tom).status == 202; });
}

TEST_F(SharedPlacesTest, OneTraineesReplaysLeavePlacesToOthers) {
  engine->first_unwatched_s = 0.0;  // watched
  const HttpReply first = replay("t0", tom);
  ASSERT_EQ(first.status, 201) << first.body;
  EXPECT_EQ(replay("t1", tom).status, 201);
  const HttpReply third = replay("t2", tom);
  expect_as_described("POST", one + "/replay", 409, third);
  EXPECT_NE(third.body.find("2 of your replays are watched"), std::string::npos) << third.body;
  EXPECT_EQ(replay("t2", token_of(tom_id)).status, 409) << "another token is the same trainee";
  EXPECT_EQ(replay("s0", tess).status, 201);
  EXPECT_EQ(replay("t0", ina).status, 201);
  expect_as_described("POST", one + "/replay", 503, replay("t0", ina));

  // Of one's own the one that nobody watches gives way, and nobody else's.
  engine->made_replay(0).set_unwatched_s(5.0);
  engine->made_replay(2).set_unwatched_s(60.0);
  EXPECT_EQ(replay("t2", tom).status, 201);
  EXPECT_EQ(request("GET", all + "/" + json::parse(first.body).at("id").get<std::string>(), tom).status, 404);
  EXPECT_EQ(replay("t3", ina).status, 201) << "tess' has gone unwatched for longest";
}

TEST_F(LivePlacesTest, OnlyStaffHasMoreForceScaleThanTheScript) {
  session::SessionContext context{folder.path(), 1, "cpu", sim::Realtime::off};
  context.guard_now_ns = [] { return int64_t{1}; };
  options.engine = std::make_shared<session::SimulationEngine>(context);
  start();
  add_user("olga", access::Role::operator_);
  const Sent tom = token_of(add_user("tom", access::Role::trainee)),
             ina = token_of(add_user("ina", access::Role::instructor));
  const auto make = [&](const Sent& as, double scale) {
    return request("POST", all, as,
                   json{{"case", "demo"}, {"script", "demo"}, {"force_scale", scale}}.dump());
  };
  const double own = device::demo_script().force_scale;
  const HttpReply more = make(tom, own * 1.01);
  expect_as_described("POST", all, 403, more);
  EXPECT_NE(more.body.find("above the script's own"), std::string::npos) << more.body;
  EXPECT_EQ(make(tom, own).status, 201);
  EXPECT_EQ(make(tom, own * 0.5).status, 201);
  EXPECT_EQ(make(ina, own * 1.01).status, 201);
}

TEST_F(LivePlacesTest, WithoutUsersTheMachineIsOnePersons) {
  start();
  for (size_t i = 0; i < options.sessions.live; ++i) EXPECT_EQ(make_session({}).status, 201) << i;
  EXPECT_EQ(make_session({}).status, 503);
}

}  // namespace
}  // namespace ream::test
