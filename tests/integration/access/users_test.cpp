#include "access/users.hpp"

#include <fstream>

#include "access/access_control.hpp"
#include "access/login_backoff.hpp"
#include "support/expect_error.hpp"
#include "support/hand_clock.hpp"
#include "support/test_databases.hpp"

namespace ream::access {
namespace {

const LoginOrigin here{"10.0.0.1"};
Secret secret(std::string_view text) { return Secret(text); }

class UsersTest : public test::TestDatabase<test::OnSqlite> {
 protected:
  UsersTest() : access_control(database(), options()) {}
  AccessOptions options() {
    AccessOptions made;
    made.now = clock.function();
    made.cost = {1, size_t{8} << 10};
    return made;
  }
  User add(const std::string& name, Role role) {
    return users.add({name, "", role, secret("password of " + name)});
  }
  IssuedCredential cookie(const std::string& user) {
    return access_control.credentials.issue(CredentialKind::cookie, {user, {}, "", "", ""});
  }
  bool good(const IssuedCredential& issued) {
    return access_control.credentials.identify_again(issued.row.id).has_value();
  }

  test::HandClock clock;
  AccessControl access_control;
  Users& users = access_control.users;
};

TEST_F(UsersTest, BeginWithAnOperator) {
  EXPECT_FALSE(users.any());
  test::expect_error(ErrorKind::conflict, "first user must be operator", [&] { add("ben", Role::trainee); });
  EXPECT_FALSE(users.any());
  const User anna = add("Anna", Role::operator_);
  EXPECT_TRUE(users.any()) << "at once";
  EXPECT_EQ(anna.name, "anna");
  EXPECT_EQ(anna.display_name, "anna");
  EXPECT_EQ(users.get(anna.id).role, Role::operator_);
  EXPECT_EQ(users.find_by_name("ANNA")->id, anna.id);
  EXPECT_FALSE(users.find_by_name("ben"));
}

TEST_F(UsersTest, BadOnesAreRefusedInWordsWithoutThePassword) {
  add("anna", Role::operator_);
  const auto refused = [&](const NewUser& user, const std::string& words) {
    test::expect_error(ErrorKind::invalid_input, words, [&] { users.add(user); });
  };
  refused({"", "", Role::trainee, secret("a good password")}, "name");
  refused({"two words", "", Role::trainee, secret("a good password")}, "name");
  refused({std::string(65, 'a'), "", Role::trainee, secret("a good password")}, "name");
  refused({"ben", "two\nlines", Role::trainee, secret("a good password")}, "one line");
  refused({"ben", "", Role::viewer, secret("a good password")}, "viewers have links");
  refused({"ben", "", Role::trainee, secret("short")}, "at least 10");
  test::expect_error(ErrorKind::conflict, "'anna' already", [&] {
    users.add({"Anna", "", Role::trainee, secret("a good password")});
  });
  EXPECT_EQ(users.list().size(), 1u);
}

TEST_F(UsersTest, LogInWithTheirPasswordOnly) {
  const User anna = add("anna", Role::operator_);
  EXPECT_EQ(users.log_in("Anna", secret("password of anna"), here)->id, anna.id);
  EXPECT_FALSE(users.log_in("anna", secret("password of ann"), here));
  EXPECT_FALSE(users.log_in("ben", secret("password of anna"), here));
  EXPECT_FALSE(users.log_in("'; DROP TABLE users; --\xff", secret("password of anna"), here));
}

TEST_F(UsersTest, GuessingIsMadeSlowForKnownAndUnknownNamesAlike) {
  add("anna", Role::operator_);
  for (const char* name : {"anna", "nobody"}) {
    for (int i = 0; i < 4; ++i) EXPECT_FALSE(users.log_in(name, secret("guess"), here)) << name;
    EXPECT_THROW(users.log_in(name, secret("password of anna"), here), TooManyAttempts) << name;
  }
  clock.pass(std::chrono::seconds(1));
  EXPECT_TRUE(users.log_in("anna", secret("password of anna"), here));
}

TEST_F(UsersTest, WhoGuessesAtTheSameAddressKeepsNobodyOut) {
  const User anna = add("anna", Role::operator_);
  const LoginOrigin hers{here.address, make_credential_secret().text};
  EXPECT_TRUE(users.log_in("anna", secret("password of anna"), hers));
  for (int round = 0; round < 50; ++round) {
    try {
      users.log_in("anna", secret("guess"), here);
    } catch (const TooManyAttempts&) {
    }
    ASSERT_TRUE(users.log_in("anna", secret("password of anna"), hers)) << round;
    ASSERT_TRUE(users.change_password(anna.id, {secret("password of anna"), secret("password of anna")},
                                      {here.address, secret("what she is logged in with"), true}));
    clock.pass(std::chrono::minutes(1));
  }
  EXPECT_THROW(
      {
        for (int i = 0; i < 9; ++i) users.log_in("anna", secret("guess"), here);
      },
      TooManyAttempts);
}

TEST_F(UsersTest, TheFirstOneEndsWhatWasMadeWhileEverybodyCouldDoEverything) {
  Credentials& credentials = access_control.credentials;
  const auto made = [&](CredentialKind kind, const std::string& parent) {
    return credentials.issue(kind, {"", {}, "", "", "", parent});
  };
  const IssuedCredential shown = made(CredentialKind::link, ""),
                         page = made(CredentialKind::cookie, shown.row.id);
  EXPECT_TRUE(good(shown));
  EXPECT_TRUE(good(page)) << "is in the cache now";
  std::vector<std::string> told;
  credentials.on_change(
      [&](const std::vector<std::string>& ids) { told.insert(told.end(), ids.begin(), ids.end()); });
  test::expect_error(ErrorKind::conflict, "first user must be operator", [&] { add("ben", Role::trainee); });
  EXPECT_TRUE(good(page));
  add("anna", Role::operator_);
  EXPECT_FALSE(good(shown));
  EXPECT_FALSE(good(page));
  std::sort(told.begin(), told.end());
  std::vector<std::string> ended{"", shown.row.id, page.row.id};
  std::sort(ended.begin(), ended.end());
  EXPECT_EQ(told, ended) << "also those who came without any";
  const IssuedCredential of_server = made(CredentialKind::link, "");
  add("ben", Role::trainee);
  EXPECT_TRUE(good(of_server)) << "was made with users";
}

TEST_F(UsersTest, ChangeTheirOwnPassword) {
  const User anna = add("anna", Role::operator_);
  const IssuedCredential this_one = cookie(anna.id), other = cookie(anna.id);
  const auto change = [&](const char* present, const char* wanted) {
    return users.change_password(anna.id, {secret(present), secret(wanted), this_one.row.id}, here);
  };
  EXPECT_FALSE(change("wrong", "a new password"));
  EXPECT_TRUE(good(other));
  EXPECT_THROW(change("password of anna", "short"), Error);
  EXPECT_TRUE(change("password of anna", "a new password"));
  EXPECT_TRUE(good(this_one));
  EXPECT_FALSE(good(other));
  EXPECT_FALSE(users.log_in("anna", secret("password of anna"), here));
  EXPECT_TRUE(users.log_in("anna", secret("a new password"), here));
}

TEST_F(UsersTest, ANewPasswordByAnOperatorEndsCookiesAndForgives) {
  add("anna", Role::operator_);
  const User ben = add("ben", Role::trainee);
  const IssuedCredential before = cookie(ben.id);
  for (int i = 0; i < 8; ++i) try {
      users.log_in("ben", secret("guess"), here);
    } catch (const TooManyAttempts&) {
      clock.pass(std::chrono::minutes(20));
    }
  UserChange change;
  change.password = secret("another password");
  users.change(ben.id, change);
  EXPECT_FALSE(good(before));
  EXPECT_TRUE(users.log_in("ben", secret("another password"), here));
}

TEST_F(UsersTest, ANewPasswordRevokesTokensAndLinksUnlessTheyAreToStay) {
  add("anna", Role::operator_);
  const User ben = add("ben", Role::instructor);
  const auto made = [&](CredentialKind kind) {
    return access_control.credentials.issue(kind, {ben.id, {}, "", "", ""});
  };
  for (const bool by_operator : {true, false})
    for (const bool keep : {true, false}) {
      SCOPED_TRACE(testing::Message() << by_operator << keep);
      const IssuedCredential token = made(CredentialKind::token), shown = made(CredentialKind::link),
                             page = made(CredentialKind::cookie), this_one = made(CredentialKind::token);
      const IssuedCredential viewer =
          access_control.credentials.issue(CredentialKind::cookie, {"", {}, "", "", "", shown.row.id});
      UserChange change{{}, {}, {}, secret("password of ben"), keep};
      if (by_operator)
        users.change(ben.id, change);
      else
        users.change_password(
            ben.id, {secret("password of ben"), secret("password of ben"), this_one.row.id, keep}, here);
      EXPECT_EQ(good(token), keep);
      EXPECT_EQ(good(shown), keep);
      EXPECT_EQ(good(viewer), keep) << "came by the link";
      EXPECT_FALSE(good(page));
      EXPECT_EQ(good(this_one), keep || !by_operator);
    }
}

TEST_F(UsersTest, DisablingRevokesAll) {
  add("anna", Role::operator_);
  const User ben = add("ben", Role::instructor);
  const IssuedCredential page = cookie(ben.id);
  const IssuedCredential shown =
      access_control.credentials.issue(CredentialKind::link, {ben.id, {}, "", "", ""});
  UserChange change;
  change.enabled = false;
  EXPECT_FALSE(users.change(ben.id, change).enabled);
  EXPECT_FALSE(good(page));
  EXPECT_FALSE(good(shown));
  EXPECT_FALSE(users.log_in("ben", secret("password of ben"), here));
  change.enabled = true;
  users.change(ben.id, change);
  EXPECT_TRUE(users.log_in("ben", secret("password of ben"), here));
}

TEST_F(UsersTest, AnotherRoleIsToldToOpenStreamsAndEndsLinks) {
  add("anna", Role::operator_);
  const User ben = add("ben", Role::instructor);
  const IssuedCredential page = cookie(ben.id);
  const IssuedCredential shown =
      access_control.credentials.issue(CredentialKind::link, {ben.id, {}, "", "", ""});
  std::vector<std::string> told;
  access_control.credentials.on_change(
      [&](const std::vector<std::string>& ids) { told.insert(told.end(), ids.begin(), ids.end()); });
  UserChange change;
  change.role = Role::trainee;
  users.change(ben.id, change);
  EXPECT_EQ(told, (std::vector<std::string>{shown.row.id, page.row.id}));
  EXPECT_EQ(access_control.credentials.identify_again(page.row.id)->role, Role::trainee);
  EXPECT_FALSE(good(shown));
}

TEST_F(UsersTest, TheLastOperatorStays) {
  const User anna = add("anna", Role::operator_);
  add("ben", Role::instructor);
  UserChange demoted, disabled;
  demoted.role = Role::instructor;
  disabled.enabled = false;
  for (const auto& action : std::vector<std::function<void()>>{[&] { users.change(anna.id, demoted); },
                                                               [&] { users.change(anna.id, disabled); },
                                                               [&] { users.remove(anna.id); }})
    test::expect_error(ErrorKind::conflict, "last operator", action);
  add("carl", Role::operator_);
  users.remove(anna.id);
  test::expect_error(ErrorKind::not_found, anna.id, [&] { users.get(anna.id); });
}

TEST_F(UsersTest, OutdatedHashesAreRenewedAtTheNextLogin) {
  add("anna", Role::operator_);
  AccessOptions dearer = options();
  dearer.cost = {2, size_t{16} << 10};
  AccessControl later(database(), dearer);
  const auto hash = [&] {
    return store::UserTable(database(), "operator").find_by_name("anna")->password_hash;
  };
  EXPECT_NE(hash().find("m=8,t=1"), std::string::npos) << hash();
  EXPECT_TRUE(later.users.log_in("anna", secret("password of anna"), here));
  EXPECT_NE(hash().find("m=16,t=2"), std::string::npos) << hash();
  EXPECT_TRUE(later.users.log_in("anna", secret("password of anna"), here));
}

TEST_F(UsersTest, AreFoundInTheDatabaseByAnotherProcess) {
  EXPECT_FALSE(users.any());
  const auto again = open_again();
  AccessControl other(*again, options());
  other.users.add({"anna", "", Role::operator_, secret("password of anna")});
  for (int i = 0; i < 300 && !users.any(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(users.any()) << "within a second or so";
}

TEST_F(UsersTest, AuditRowsSayWhoDidWhatWhere) {
  access_control.audit.note({"u1", "anna", "operator", "c1", here.address}, "user.add", "u2",
                            "ben as trainee");
  const auto rows = access_control.audit.list(INT64_MAX, 10);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].at_utc, "2026-01-31T12:00:00Z");
  EXPECT_EQ(rows[0].name, "anna");
  EXPECT_EQ(rows[0].address, here.address);
  EXPECT_EQ(rows[0].detail, "ben as trainee");
}

}  // namespace
}  // namespace ream::access
