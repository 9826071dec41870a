#include "access/secret.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <ostream>
#include <type_traits>

namespace ream::access {
namespace {

template <typename T>
concept Printable = requires(std::ostream& out, const T& value) {
  out << value;
};

static_assert(!Printable<Secret>);
static_assert(!std::is_convertible_v<Secret, std::string>);
static_assert(!std::is_constructible_v<nlohmann::json, Secret>);

TEST(Secret, TakesTheTextOutOfWhatItCameIn) {
  for (const size_t length : {size_t{5}, size_t{200}}) {
    std::string text(length, 'x');
    const Secret secret(std::move(text));
    EXPECT_EQ(secret.reveal(), std::string(length, 'x'));
    EXPECT_EQ(text, "");  // NOLINT(bugprone-use-after-move): that it is wiped is the point
    text.resize(text.capacity());
    EXPECT_EQ(text.find('x'), std::string::npos);
  }
}

TEST(Secret, IsMovedWithoutATrace) {
  Secret one(std::string_view("short"));
  const Secret two(std::move(one));
  EXPECT_EQ(two.reveal(), "short");
  EXPECT_TRUE(one.empty());  // NOLINT(bugprone-use-after-move)
  Secret three(std::string_view("another secret, too long for the string's own room"));
  three = Secret(std::string_view("the last"));
  EXPECT_EQ(three.reveal(), "the last");
  const Secret four = three;
  EXPECT_EQ(four.reveal(), three.reveal());
}

TEST(Secret, WipeOverwritesAllThatWasHeld) {
  std::string text = "a password of thirty characters";
  text.resize(4);
  wipe(text);
  text.resize(31);
  EXPECT_EQ(text, std::string(31, '\0'));
}

TEST(Secret, TextsAreComparedWhole) {
  EXPECT_TRUE(equal_in_constant_time("", ""));
  EXPECT_TRUE(equal_in_constant_time("abc", "abc"));
  EXPECT_FALSE(equal_in_constant_time("abc", "abd"));
  EXPECT_FALSE(equal_in_constant_time("abc", "abcd"));
  EXPECT_FALSE(equal_in_constant_time("", "a"));
}

}  // namespace
}  // namespace ream::access
