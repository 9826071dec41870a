#include "core/lower.hpp"

#include <gtest/gtest.h>

namespace ream {
namespace {

TEST(Lower, MakesOnlyTheLettersOfAsciiSmall) {
  EXPECT_EQ(lower("Content-TYPE @[`{ 0_9 \xc3\x84"), "content-type @[`{ 0_9 \xc3\x84");
  EXPECT_EQ(lower("AZaz"), "azaz");
  EXPECT_EQ(lower(""), "");
}

}  // namespace
}  // namespace ream
