#include "net/file_body.hpp"

#include <gtest/gtest.h>

namespace ream::net {
namespace {

using Answer = ByteRange::Answer;

void expect_part(const char* header, uint64_t offset, uint64_t bytes) {
  const ByteRange range = read_range(header, 1000);
  EXPECT_EQ(range.answer, Answer::part) << header;
  EXPECT_EQ(range.offset, offset) << header;
  EXPECT_EQ(range.bytes, bytes) << header;
}

TEST(ByteRange, OneRangeInItsThreeForms) {
  expect_part("bytes=0-99", 0, 100);
  expect_part("bytes=999-999", 999, 1);
  expect_part("bytes=100-", 100, 900);
  expect_part("bytes=-100", 900, 100);
}

TEST(ByteRange, EndsWithTheBody) {
  expect_part("bytes=990-5000", 990, 10);
  expect_part("bytes=990-99999999999999999999999999", 990, 10);
  expect_part("bytes=-5000", 0, 1000);
}

TEST(ByteRange, OutsideOfTheBodyIsUnsatisfiable) {
  for (const char* header : {"bytes=1000-", "bytes=1000-1001", "bytes=-0", "bytes=99999999999999999999999-"})
    EXPECT_EQ(read_range(header, 1000).answer, Answer::unsatisfiable) << header;
  EXPECT_EQ(read_range("bytes=0-", 0).answer, Answer::unsatisfiable);
  EXPECT_EQ(read_range("bytes=-5", 0).answer, Answer::unsatisfiable);
}

TEST(ByteRange, WhatIsNotUnderstoodAsksForTheWhole) {
  for (const char* header :
       {"", "bytes", "bytes=", "bytes=-", "bytes=5", "bytes=9-5", "bytes=a-b", "bytes=0-1,5-6", "bytes=1-x",
        "bytes= 1-2", "bytes=+1-2", "bytes=--5", "items=0-5", "Bytes=0-5"})
    EXPECT_EQ(read_range(header, 1000).answer, Answer::whole) << header;
}

}  // namespace
}  // namespace ream::net
