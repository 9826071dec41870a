#include "access/credentials.hpp"

#include <thread>

#include "access/secret.hpp"
#include "support/expect_error.hpp"
#include "support/hand_clock.hpp"
#include "support/test_databases.hpp"

namespace ream::access {
namespace {

using std::chrono::hours;
using std::chrono::minutes;
using Ids = std::vector<std::string>;

class CredentialsTest : public test::TestDatabase<test::OnSqlite> {
 protected:
  CredentialsTest() {
    for (const char* name : {"operator", "instructor", "trainee"})
      users.add({name, name, name, name, "2026-01-31T12:00:00Z", "hash", true});
  }
  IssuedCredential token(const std::string& user, std::optional<Role> limit = std::nullopt) {
    return credentials.issue(CredentialKind::token, {user, limit, "robot", "", ""});
  }
  IssuedCredential link(const std::string& maker, const std::string& session = {}) {
    return credentials.issue(CredentialKind::link, {maker, std::nullopt, "visit", session, ""});
  }
  std::optional<Role> role_of(const IssuedCredential& issued) {
    const auto identity = credentials.identify(issued.secret, CredentialKind::token);
    return identity ? std::optional(identity->role) : std::nullopt;
  }
  void change(const std::string& user, const std::function<void(store::UserRow&)>& how) {
    users.change(user, how);
    credentials.renew(user);
  }

  test::HandClock clock;
  store::UserTable users{database(), "operator"};
  Credentials credentials{database(), clock.function()};
};

TEST_F(CredentialsTest, StandForTheirUser) {
  const IssuedCredential issued = token("trainee");
  const auto identity = credentials.identify(issued.secret, CredentialKind::token);
  ASSERT_TRUE(identity);
  EXPECT_EQ(identity->credential, issued.row.id);
  EXPECT_EQ(identity->user_id, "trainee");
  EXPECT_EQ(identity->role, Role::trainee);
  EXPECT_EQ(identity->only_session, "");
  EXPECT_EQ(identity->expires_utc, issued.row.expires_utc);
}

TEST_F(CredentialsTest, AreUnusedUntilTheFirstUse) {
  const IssuedCredential issued = token("operator");
  EXPECT_EQ(credentials.find(issued.row.id, CredentialKind::token)->last_used_utc, "");
  ASSERT_TRUE(credentials.identify(issued.secret, CredentialKind::token));
  EXPECT_EQ(credentials.find(issued.row.id, CredentialKind::token)->last_used_utc,
            utc_text(clock.function()()));
}

TEST_F(CredentialsTest, AreOfOneKindOnly) {
  const IssuedCredential issued = token("operator");
  EXPECT_FALSE(credentials.identify(issued.secret, CredentialKind::cookie));
  EXPECT_FALSE(credentials.identify(issued.secret, CredentialKind::link));
  EXPECT_FALSE(credentials.identify(link("operator").secret, CredentialKind::token));
}

TEST_F(CredentialsTest, ASecretThatIsNotWholeIsWorthNothing) {
  const IssuedCredential issued = token("operator");
  EXPECT_FALSE(credentials.identify(Secret(), CredentialKind::token));
  EXPECT_FALSE(credentials.identify(make_credential_secret().text, CredentialKind::token));
  std::string changed = issued.secret.reveal();
  changed.back() = changed.back() == 'A' ? 'B' : 'A';
  EXPECT_FALSE(credentials.identify(Secret(std::string_view(changed)), CredentialKind::token));
  EXPECT_FALSE(credentials.identify(Secret(std::string_view(issued.row.hash)), CredentialKind::token));
  EXPECT_TRUE(credentials.identify(issued.secret, CredentialKind::token));
}

TEST_F(CredentialsTest, ATokenMayBeNarrowerThanItsUserAndNeverWider) {
  const IssuedCredential viewer = token("instructor", Role::viewer);
  EXPECT_EQ(role_of(viewer), Role::viewer);
  const IssuedCredential wide = token("trainee", Role::operator_);
  EXPECT_FALSE(role_of(wide));
  change("instructor", [](store::UserRow& row) { row.role = "trainee"; });
  EXPECT_FALSE(role_of(viewer)) << "a trainee's token may not see all";
}

TEST_F(CredentialsTest, FollowTheirUser) {
  const IssuedCredential of_trainee = token("trainee"), of_instructor = token("instructor");
  const IssuedCredential shown = link("instructor");
  EXPECT_EQ(role_of(of_trainee), Role::trainee);
  change("trainee", [](store::UserRow& row) { row.role = "instructor"; });
  EXPECT_EQ(role_of(of_trainee), Role::instructor);
  change("trainee", [](store::UserRow& row) { row.enabled = false; });
  EXPECT_FALSE(role_of(of_trainee));
  EXPECT_TRUE(credentials.identify_again(shown.row.id));
  users.remove("instructor");
  credentials.renew("instructor");
  EXPECT_FALSE(role_of(of_instructor));
  EXPECT_FALSE(credentials.identify(shown.secret, CredentialKind::link)) << "who made it has gone";
}

TEST_F(CredentialsTest, EndInTime) {
  const IssuedCredential issued = token("trainee");
  clock.pass(hours(24 * 90) - minutes(1));
  EXPECT_TRUE(role_of(issued));
  clock.pass(minutes(1));
  EXPECT_FALSE(role_of(issued));
  EXPECT_FALSE(credentials.identify_again(issued.row.id));
  EXPECT_TRUE(credentials.list(CredentialKind::token, "").empty());
}

TEST_F(CredentialsTest, CookiesEndAlsoWhenNobodyUsesThem) {
  const IssuedCredential cookie = credentials.issue(CredentialKind::cookie, {"trainee", {}, "", "", ""});
  for (int i = 0; i < 12; ++i) {
    clock.pass(minutes(100));
    EXPECT_TRUE(i % 2 == 0 ? credentials.identify(cookie.secret, CredentialKind::cookie).has_value()
                           : credentials.identify_again(cookie.row.id).has_value());
  }
  clock.pass(minutes(121));
  EXPECT_FALSE(credentials.identify(cookie.secret, CredentialKind::cookie));
  const IssuedCredential busy = credentials.issue(CredentialKind::cookie, {"trainee", {}, "", "", ""});
  for (int i = 0; i < 23; ++i) {
    clock.pass(hours(1));
    EXPECT_TRUE(credentials.identify(busy.secret, CredentialKind::cookie)) << i;
  }
  clock.pass(hours(1));
  EXPECT_FALSE(credentials.identify(busy.secret, CredentialKind::cookie)) << "at most a day";
}

TEST_F(CredentialsTest, TheEndThatIsAskedForMustBeInReach) {
  const auto with_end = [&](const std::string& utc) {
    return credentials.issue(CredentialKind::token, {"trainee", {}, "", "", utc});
  };
  EXPECT_EQ(with_end("2026-02-01T00:00:00Z").row.expires_utc, "2026-02-01T00:00:00Z");
  for (const char* utc : {"2026-01-31T12:00:00Z", "2020-01-01T00:00:00Z", "2028-01-01T00:00:00Z", "soon"})
    EXPECT_THROW(with_end(utc), Error) << utc;
}

TEST_F(CredentialsTest, RevocationHoldsAtOnceAndIsTold) {
  std::vector<Ids> told;
  credentials.on_change([&](const Ids& ids) { told.push_back(ids); });
  const IssuedCredential shown = link("instructor", "s1");
  const IssuedCredential cookie =
      credentials.issue(CredentialKind::cookie, {"", {}, "", "s1", "", shown.row.id});
  const auto guest = credentials.identify(cookie.secret, CredentialKind::cookie);
  ASSERT_TRUE(guest);
  EXPECT_EQ(guest->role, Role::viewer);
  EXPECT_EQ(guest->only_session, "s1");
  EXPECT_EQ(guest->user_id, "");
  credentials.revoke(shown.row.id);
  EXPECT_FALSE(credentials.identify(shown.secret, CredentialKind::link));
  EXPECT_FALSE(credentials.identify(cookie.secret, CredentialKind::cookie));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0], (Ids{shown.row.id, cookie.row.id}));
  credentials.revoke("unknown");
  EXPECT_EQ(told.size(), 1u);
}

TEST_F(CredentialsTest, AllOfAUserCanBeEnded) {
  const auto cookie = [&] {
    return credentials.issue(CredentialKind::cookie, {"instructor", {}, "", "", ""});
  };
  const IssuedCredential here = cookie(), there = cookie(), robot = token("instructor"),
                         shown = link("instructor");
  credentials.end_old_logins("instructor", here.row.id, true);
  EXPECT_TRUE(credentials.identify(here.secret, CredentialKind::cookie));
  EXPECT_FALSE(credentials.identify(there.secret, CredentialKind::cookie));
  credentials.revoke_links("instructor");
  EXPECT_FALSE(credentials.identify(shown.secret, CredentialKind::link));
  EXPECT_TRUE(role_of(robot));
  credentials.revoke_all("instructor");
  EXPECT_FALSE(role_of(robot));
  EXPECT_FALSE(credentials.identify(here.secret, CredentialKind::cookie));
}

TEST_F(CredentialsTest, AnotherProcessSeesARevocationWithinSeconds) {
  const auto again = open_again();
  Credentials other(*again, clock.function());
  const IssuedCredential issued = token("trainee");
  ASSERT_TRUE(other.identify(issued.secret, CredentialKind::token));
  credentials.revoke(issued.row.id);
  std::this_thread::sleep_for(Credentials::cache_time + std::chrono::milliseconds(50));
  EXPECT_FALSE(other.identify(issued.secret, CredentialKind::token));
}

TEST_F(CredentialsTest, AreListedWithoutTheirSecrets) {
  const IssuedCredential one = token("trainee");
  token("instructor");
  const auto rows = credentials.list(CredentialKind::token, "trainee");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0], one.row);
  EXPECT_EQ(rows[0].hash.find(one.secret.reveal().substr(16)), std::string::npos);
  EXPECT_EQ(credentials.list(CredentialKind::token, "").size(), 2u);
  EXPECT_TRUE(credentials.find(one.row.id, CredentialKind::token));
  EXPECT_FALSE(credentials.find(one.row.id, CredentialKind::link));
}

TEST_F(CredentialsTest, WhatHasEndedStaysSoWhenTheClockGoesBack) {
  const IssuedCredential short_lived =
      credentials.issue(CredentialKind::token, {"operator", {}, "", "", "2026-01-31T14:00:00Z"});
  const IssuedCredential long_lived = token("operator");
  ASSERT_TRUE(role_of(short_lived));
  clock.pass(hours(3));
  EXPECT_FALSE(role_of(short_lived));
  EXPECT_TRUE(role_of(long_lived));
  clock.pass(-hours(2) - minutes(30));
  EXPECT_FALSE(role_of(short_lived)) << "it had ended";
  EXPECT_TRUE(role_of(long_lived));
  const IssuedCredential later =
      credentials.issue(CredentialKind::token, {"operator", {}, "", "", "2026-01-31T13:00:00Z"});
  EXPECT_TRUE(role_of(later)) << "made after it, good by the clock of today";
}

TEST_F(CredentialsTest, TheLatestTimeIsKeptAcrossProcesses) {
  const IssuedCredential issued = token("operator");
  clock.pass(hours(24 * 91));
  EXPECT_FALSE(role_of(issued));
  clock.pass(-hours(24 * 90));
  const auto again = open_again();
  Credentials next(*again, clock.function());
  EXPECT_FALSE(next.identify(issued.secret, CredentialKind::token));
  const IssuedCredential fresh = next.issue(CredentialKind::token, {"operator", {}, "", "", ""});
  EXPECT_TRUE(next.identify(fresh.secret, CredentialKind::token));
  EXPECT_TRUE(role_of(fresh)) << "nobody turns back twice";
}

TEST_F(CredentialsTest, WhatAClockMadeThatWasAheadEnds) {
  const IssuedCredential before = token("operator");
  clock.pass(hours(24 * 80));
  const IssuedCredential cookie = credentials.issue(CredentialKind::cookie, {"operator", {}, "", "", ""});
  EXPECT_TRUE(credentials.identify(cookie.secret, CredentialKind::cookie));
  EXPECT_TRUE(role_of(before));
  std::vector<std::string> told;
  credentials.on_change([&](const Ids& ids) { told.insert(told.end(), ids.begin(), ids.end()); });
  clock.pass(-hours(24 * 80));
  EXPECT_FALSE(credentials.identify(cookie.secret, CredentialKind::cookie)) << "good for 81 days else";
  EXPECT_TRUE(role_of(before));
  EXPECT_EQ(told, Ids{cookie.row.id}) << "streams hear of it";
}

TEST_F(CredentialsTest, AClockThatIsSetRightALittleEndsNothing) {
  const IssuedCredential issued = token("operator");
  EXPECT_TRUE(role_of(issued));
  clock.pass(-std::chrono::seconds(100));
  EXPECT_TRUE(role_of(issued));
}

}  // namespace
}  // namespace ream::access
