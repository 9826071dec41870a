#include "core/text.hpp"

#include <gtest/gtest.h>

namespace ream::test {
namespace {

TEST(Lower, MakesOnlyTheLettersOfAsciiSmall) {
  EXPECT_EQ(lower("Content-TYPE @[`{ 0_9 \xc3\x84"), "content-type @[`{ 0_9 \xc3\x84");
  EXPECT_EQ(lower("AZaz"), "azaz");
  EXPECT_EQ(lower(""), "");
}

TEST(Hex, OfEveryByteComesBack) {
  std::string bytes;
  for (int byte = 0; byte < 256; ++byte) bytes += static_cast<char>(byte);
  const std::string hex = hex_of(bytes);
  EXPECT_EQ(hex.substr(0, 6), "000102");
  EXPECT_EQ(hex.substr(hex.size() - 4), "feff");
  EXPECT_EQ(bytes_from_hex(hex), bytes);
  EXPECT_EQ(hex_of(""), "");
}

TEST(Hex, WhatIsNoneIsNothing) {
  for (const char* wrong : {"", "0", "abc", "0g", "g0", "FF", " 0", "00 "})
    EXPECT_EQ(bytes_from_hex(wrong), "") << wrong;
}

}  // namespace
}  // namespace ream::test
