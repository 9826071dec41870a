#include "core/hash.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <set>

namespace ream {
namespace {

TEST(Mix64, IsSplitmix64) {
  // Published outputs of splitmix64 seeded with 1234567; its state grows by the golden ratio each step.
  const uint64_t expected[] = {6457827717110365317u, 3203168211198807973u, 9817491932198370423u,
                               4593380528125082431u, 16408922859458223821u};
  uint64_t state = 1234567;
  for (const uint64_t value : expected) {
    EXPECT_EQ(mix64(state), value);
    state += 0x9e3779b97f4a7c15u;
  }
}

TEST(Mix64, ChangesHalfTheBitsWhenOneChanges) {
  uint64_t flipped = 0;
  for (uint64_t x = 0; x < 256; ++x)
    for (int bit = 0; bit < 64; ++bit)
      flipped += static_cast<uint64_t>(std::popcount(mix64(x) ^ mix64(x ^ (uint64_t{1} << bit))));
  EXPECT_NEAR(static_cast<double>(flipped) / (256.0 * 64.0), 32.0, 0.2);
}

TEST(HashText, HasKnownValues) {
  // Computed by a separate program from the definition: length first, little-endian words, then the tail.
  EXPECT_EQ(to_hex(hash_text("")), "a7f72697a2731486");
  EXPECT_EQ(to_hex(hash_text("glenoid")), "20b631d7c9c12904");
  EXPECT_EQ(to_hex(hash_text("glenoid reaming")), "c690b130b5df4fda");
  EXPECT_EQ(to_hex(hash_text("glenoid reaming", 7)), "eddafb2cbcd63c33");
}

TEST(HashText, TellsLengthsOfEqualBytesApart) {
  std::set<uint64_t> seen;
  for (size_t n = 0; n < 100; ++n) seen.insert(hash_text(std::string(n, '\0')));
  EXPECT_EQ(seen.size(), 100u);
}

TEST(HashCombine, DependsOnOrder) {
  EXPECT_NE(hash_combine(hash_combine(0, 1), 2), hash_combine(hash_combine(0, 2), 1));
}

TEST(ToHex, PadsToSixteenDigits) {
  EXPECT_EQ(to_hex(0), "0000000000000000");
  EXPECT_EQ(to_hex(0xfedcba9876543210u), "fedcba9876543210");
}

}  // namespace
}  // namespace ream
