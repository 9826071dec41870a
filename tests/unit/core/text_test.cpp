#include "core/text.hpp"

#include <gtest/gtest.h>

#include <span>

namespace ream::test {
namespace {

TEST(Lower, MakesOnlyTheLettersOfAsciiSmall) {
  EXPECT_EQ(lower("Content-TYPE @[`{ 0_9 \xc3\x84"), "content-type @[`{ 0_9 \xc3\x84");
  EXPECT_EQ(lower("AZaz"), "azaz");
  EXPECT_EQ(lower(""), "");
}

TEST(OneLine, HasNoControlCharactersAndAnEnd) {
  EXPECT_EQ(one_line("a\nb\tc\x7f\x1b[31m", 100), "a b c  [31m");
  EXPECT_EQ(one_line("f\xc3\xbcnf", 100), "f\xc3\xbcnf");
  EXPECT_EQ(one_line("0123456789", 10), "0123456789");
  EXPECT_EQ(one_line("0123456789a", 10), "0123456789 ...");
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

std::string base64_of(std::string_view text) {
  return base64(std::as_bytes(std::span(text.data(), text.size())));
}

TEST(Base64, MatchesTheVectorsOfRfc4648) {
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foo"), "Zm9v");
  EXPECT_EQ(base64_of("foob"), "Zm9vYg==");
  EXPECT_EQ(base64_of("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64_of("\xff\xfe\xfd"), "//79");
}

}  // namespace
}  // namespace ream::test
