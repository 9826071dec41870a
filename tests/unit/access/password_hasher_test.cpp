#include "access/password_hasher.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "access/login_backoff.hpp"

namespace ream::access {
namespace {

const HashCost cheap{1, size_t{8} << 10};
Secret password(std::string_view text) { return Secret(text); }

TEST(PasswordHasher, KnowsThePasswordAgain) {
  PasswordHasher hasher(2, cheap);
  const std::string hash = hasher.hash(password("open sesame"));
  EXPECT_EQ(hash.rfind("$argon2id$", 0), 0u);
  EXPECT_EQ(hash.find("sesame"), std::string::npos);
  EXPECT_TRUE(hasher.verify(password("open sesame"), hash).right);
  EXPECT_FALSE(hasher.verify(password("open sesamE"), hash).right);
  EXPECT_FALSE(hasher.verify(password(""), hash).right);
  EXPECT_NE(hasher.hash(password("open sesame")), hash) << "each has a salt of its own";
}

TEST(PasswordHasher, UsuallyTakesTheCostOfAnInteractiveLogin) {
  PasswordHasher hasher;
  EXPECT_NE(hasher.hash(password("open sesame")).find("$m=65536,t=2,p=1$"), std::string::npos);
}

TEST(PasswordHasher, NobodysPasswordIsAlwaysWrong) {
  PasswordHasher hasher(2, cheap);
  EXPECT_FALSE(hasher.verify(password("open sesame"), "").right);
  EXPECT_FALSE(hasher.verify(password("nobody's password"), "").right);
  EXPECT_FALSE(hasher.verify(password("open sesame"), "not a hash").right);
}

TEST(PasswordHasher, SaysWhenAHashWasMadeAtAnotherCost) {
  PasswordHasher before(2, cheap), after(2, {2, size_t{16} << 10});
  const std::string old = before.hash(password("open sesame"));
  const auto verdict = after.verify(password("open sesame"), old);
  EXPECT_TRUE(verdict.right);
  EXPECT_TRUE(verdict.outdated);
  EXPECT_FALSE(after.verify(password("wrong"), old).outdated);
  EXPECT_FALSE(before.verify(password("open sesame"), old).outdated);
}

TEST(PasswordHasher, RefusesACrowdAtOnceAndServesTheRest) {
  PasswordHasher hasher(2, {8, size_t{32} << 20});
  std::atomic<int> served{0}, refused{0}, retry{0};
  std::vector<std::thread> crowd;
  for (int i = 0; i < 12; ++i)
    crowd.emplace_back([&] {
      try {
        hasher.hash(password("open sesame"));
        ++served;
      } catch (const TooManyAttempts& busy) {
        ++refused;
        retry = busy.retry_after_s();
      }
    });
  for (std::thread& one : crowd) one.join();
  EXPECT_EQ(served + refused, 12);
  EXPECT_GE(served, 2);
  EXPECT_GT(refused, 0);
  EXPECT_GT(retry, 0);
  EXPECT_NO_THROW(hasher.hash(password("open sesame"))) << "places are given back";
}

}  // namespace
}  // namespace ream::access
