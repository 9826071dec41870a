#include "record/columns.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "support/seed.hpp"

namespace ream::record {
namespace {

using Words = std::vector<uint32_t>;

void expect_back(const Words& words, uint32_t columns) {
  std::vector<std::byte> stored;
  put_columns(stored, words, columns);
  const auto rows = static_cast<uint32_t>(columns == 0 ? 0 : words.size() / columns);
  EXPECT_EQ(stored.size(), columns + 4 * words.size());
  Words back;
  ASSERT_TRUE(take_columns(stored, rows, columns, back));
  EXPECT_EQ(back, words);
}

TEST(Columns, AnyWordsComeBack) {
  std::mt19937 random(test::seed());
  for (const uint32_t columns : {1u, 2u, 7u, 64u})
    for (const uint32_t rows : {0u, 1u, 2u, 3u, 250u}) {
      Words words(rows * columns);
      for (uint32_t& word : words) word = static_cast<uint32_t>(random()) >> random() % 32;
      expect_back(words, columns);
    }
}

TEST(Columns, ExtremesComeBackFromEveryWayOfStoringThem) {
  constexpr uint32_t ends[] = {0, 1, 0x7fffffff, 0x80000000, 0x80000001, 0xffffffff, 0x7fc00000, 0xff800001};
  // What leads in decides the way that is taken: constant, rising, curved, flipping bits.
  for (int lead = 0; lead < 4; ++lead)
    for (const uint32_t a : ends)
      for (const uint32_t b : ends) {
        Words column;
        for (uint32_t i = 0; i < 60; ++i)
          column.push_back(lead == 0 ? 5 : lead == 1 ? 1000 * i : lead == 2 ? 900 * i * i : (i & 1) << 30);
        column.insert(column.end(), {a, b, a, a, b, b, ~a});
        expect_back(column, 1);
      }
}

TEST(Columns, SmoothColumnsBecomeSmallResiduals) {
  Words column;
  for (uint32_t i = 0; i < 100; ++i) column.push_back(3000000000u + 12345 * i + 7 * i * i);
  std::vector<std::byte> stored;
  put_columns(stored, column, 1);
  // Beyond the first two rows, every residual of a parabola is 14: the upper three planes are empty.
  for (size_t plane = 0; plane < 3; ++plane)
    for (size_t row = 2; row < 100; ++row) EXPECT_EQ(stored[1 + 100 * plane + row], std::byte{0});
  for (size_t row = 2; row < 100; ++row) EXPECT_EQ(stored[1 + 300 + row], std::byte{28});
}

TEST(Columns, BytesThatAreNotExactlyTheRowsAreRefused) {
  std::vector<std::byte> stored;
  put_columns(stored, Words{1, 2, 3, 4, 5, 6}, 2);
  Words back;
  EXPECT_TRUE(take_columns(stored, 3, 2, back));
  for (const auto& [rows, columns] : {std::pair{2u, 2u},
                                      {4u, 2u},
                                      {3u, 1u},
                                      {2u, 3u},
                                      {0u, 2u},
                                      {std::numeric_limits<uint32_t>::max(), 2u}}) {
    Words untouched;
    EXPECT_FALSE(take_columns(stored, rows, columns, untouched)) << rows << " x " << columns;
    EXPECT_EQ(untouched.capacity(), 0u);
  }
  stored[0] = std::byte{4};
  EXPECT_FALSE(take_columns(stored, 3, 2, back)) << "there is no fifth way";
  EXPECT_FALSE(take_columns({}, 0, 2, back));
}

}  // namespace
}  // namespace ream::record
