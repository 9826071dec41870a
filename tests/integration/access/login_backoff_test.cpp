#include "access/login_backoff.hpp"

#include "support/hand_clock.hpp"
#include "support/test_databases.hpp"

namespace ream::access {
namespace {

using std::chrono::hours;
using std::chrono::seconds;

class LoginBackoffTest : public test::TestDatabase<test::OnSqlite> {
 protected:
  /// Seconds to wait; 0: none.
  int wait(const std::string& name, const std::string& address, const std::string& device = {}) {
    try {
      backoff.require_allowed(name, from(address, device));
      return 0;
    } catch (const TooManyAttempts& refused) {
      return refused.retry_after_s();
    }
  }
  void fail(int times, const std::string& name, const std::string& address, const std::string& device = {}) {
    for (int i = 0; i < times; ++i) backoff.note_failure(name, from(address, device));
  }
  static LoginOrigin from(const std::string& address, const std::string& device = {}) {
    return {address, Secret(std::string_view(device))};
  }
  test::HandClock clock;
  LoginBackoff backoff{database(), clock.function()};
};

TEST(LoginPatience, DoublesUpToItsEnd) {
  const BackoffPolicy policy{3, seconds(60), hours(1)};
  EXPECT_EQ(wait_after(0, policy), seconds(0));
  EXPECT_EQ(wait_after(2, policy), seconds(0));
  EXPECT_EQ(wait_after(3, policy), seconds(1));
  EXPECT_EQ(wait_after(6, policy), seconds(8));
  EXPECT_EQ(wait_after(9, policy), seconds(60));
  EXPECT_EQ(wait_after(1'000'000, policy), seconds(60));
}

TEST(LoginPlace, IsANetworkWithIpv6) {
  EXPECT_EQ(place_of("192.168.1.4"), "192.168.1.4");
  EXPECT_EQ(place_of("::ffff:192.168.1.4"), "192.168.1.4");
  EXPECT_EQ(place_of("2001:db8:1:2:3:4:5:6"), place_of("2001:db8:1:2::9"));
  EXPECT_NE(place_of("2001:db8:1:2::9"), place_of("2001:db8:1:3::9"));
  EXPECT_EQ(place_of("nowhere"), "nowhere");
}

TEST_F(LoginBackoffTest, SomeFailuresAreFreeThenTheWaitGrowsAndPasses) {
  fail(3, "anna", "10.0.0.1");
  EXPECT_EQ(wait("anna", "10.0.0.1"), 0);
  fail(1, "anna", "10.0.0.1");
  EXPECT_EQ(wait("anna", "10.0.0.1"), 1);
  fail(4, "anna", "10.0.0.1");
  EXPECT_EQ(wait("anna", "10.0.0.1"), 16);
  clock.pass(seconds(15));
  EXPECT_EQ(wait("anna", "10.0.0.1"), 1);
  clock.pass(seconds(1));
  EXPECT_EQ(wait("anna", "10.0.0.1"), 0);
  fail(100, "anna", "10.0.0.1");
  EXPECT_EQ(wait("anna", "10.0.0.1"), 900);
}

TEST_F(LoginBackoffTest, SuccessAndADayForgive) {
  fail(10, "anna", "10.0.0.1");
  backoff.note_success("anna", from("10.0.0.1"));
  EXPECT_EQ(wait("anna", "10.0.0.1"), 0);
  fail(10, "ben", "10.0.0.1");
  clock.pass(hours(25));
  EXPECT_EQ(wait("ben", "10.0.0.1"), 0);
  fail(3, "ben", "10.0.0.1");
  EXPECT_EQ(wait("ben", "10.0.0.1"), 0) << "counted anew";
}

TEST_F(LoginBackoffTest, NamesThatDoNotExistAreTreatedAlike) {
  for (const char* name : {"anna", "nobody at all", "", "\xff\x00"}) {
    fail(5, name, "10.0.0.1");
    EXPECT_EQ(wait(name, "10.0.0.1"), 2) << name;
  }
}

TEST_F(LoginBackoffTest, GuessingFromManyPlacesIsSlowButTheUsualPlaceStaysOpen) {
  backoff.note_success("anna", from("10.0.0.1"));
  for (int i = 0; i < 40; ++i) fail(1, "anna", "10.9.9." + std::to_string(i));
  EXPECT_EQ(wait("anna", "10.9.9.200"), 300);
  EXPECT_EQ(wait("anna", "10.0.0.1"), 0);
  EXPECT_EQ(wait("ben", "10.9.9.200"), 0);
}

TEST_F(LoginBackoffTest, OneWhoGuessesDoesNotLockOutAHospitalBehindOneAddress) {
  for (int i = 0; i < 30; ++i) backoff.note_success("doctor" + std::to_string(i), from("10.0.0.1"));
  for (int i = 0; i < 300; ++i) fail(1, "guess" + std::to_string(i), "10.0.0.1");
  fail(50, "doctor7", "10.0.0.1");
  EXPECT_GT(wait("doctor7", "10.0.0.1"), 0) << "is guessed at";
  for (int i = 0; i < 30; ++i)
    EXPECT_TRUE(i == 7 || wait("doctor" + std::to_string(i), "10.0.0.1") == 0) << i;
  EXPECT_EQ(wait("a new one", "10.0.0.1"), 60);
  clock.pass(seconds(60));
  EXPECT_EQ(wait("a new one", "10.0.0.1"), 0);
}

TEST_F(LoginBackoffTest, IsKeptAcrossProcessesWithoutNamesAndAddresses) {
  fail(6, "anna", "10.0.0.1");
  const auto again = open_again();
  LoginBackoff other(*again, clock.function());
  EXPECT_THROW(other.require_allowed("anna", from("10.0.0.1")), TooManyAttempts);
  other.forget("anna");
  EXPECT_EQ(wait("anna", "10.0.0.1"), 0);
}

TEST_F(LoginBackoffTest, AKnownBrowserCountsByItself) {
  backoff.note_success("anna", from("10.0.0.1", "hers"));
  fail(50, "anna", "10.0.0.1");
  fail(50, "anna", "10.0.0.1", "of the one who guesses");
  EXPECT_EQ(wait("anna", "10.0.0.1"), 900);
  EXPECT_EQ(wait("anna", "10.0.0.1", "of the one who guesses"), 900) << "a browser of one's own helps nobody";
  EXPECT_EQ(wait("anna", "10.0.0.1", "hers"), 0);
  EXPECT_EQ(wait("anna", "172.16.0.9", "hers"), 0) << "wherever it is";
  EXPECT_EQ(wait("ben", "172.16.0.9", "hers"), 0);
  fail(5, "anna", "10.0.0.1", "hers");
  EXPECT_EQ(wait("anna", "10.0.0.1", "hers"), 2) << "who has stolen it waits, too";
  EXPECT_EQ(wait("anna", "172.16.0.9"), 300) << "and its failures are not other places'";
  backoff.note_success("anna", from("10.0.0.1", "hers"));
  EXPECT_EQ(wait("anna", "10.0.0.1", "hers"), 0);
  EXPECT_EQ(wait("anna", "10.0.0.1"), 900) << "success there says nothing of the others";
  clock.pass(hours(24 * 91));
  fail(50, "anna", "10.0.0.1");
  EXPECT_EQ(wait("anna", "10.0.0.1", "hers"), 900) << "forgotten after 90 days";
}

TEST_F(LoginBackoffTest, ABrowserIsKnownForTheUsersThatUsedItOnly) {
  backoff.note_success("anna", from("10.0.0.1", "shared"));
  fail(50, "ben", "10.0.0.1");
  EXPECT_EQ(wait("ben", "10.0.0.1", "shared"), 900);
}

TEST_F(LoginBackoffTest, AMomentOfAWrongClockLocksNobodyOutForLong) {
  clock.pass(hours(24 * 365));
  fail(30, "anna", "10.0.0.1");
  backoff.note_success("ben", from("10.0.0.2"));
  clock.pass(-hours(24 * 365));
  EXPECT_EQ(wait("anna", "10.0.0.1"), 900) << "as of now, not of next year";
  EXPECT_EQ(wait("anna", "10.9.9.9"), 300);
  clock.pass(seconds(899));
  EXPECT_EQ(wait("anna", "10.0.0.1"), 1) << "the wait goes by";
  clock.pass(seconds(1));
  EXPECT_EQ(wait("anna", "10.0.0.1"), 0);
}

}  // namespace
}  // namespace ream::access
