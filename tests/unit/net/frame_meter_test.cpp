#include "net/frame_meter.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "support/seed.hpp"

namespace ream::net {
namespace {

size_t count(FrameMeter& meter, const std::string& bytes) {
  return meter.count(std::as_bytes(std::span(bytes)));
}

/// A frame as RFC 6455, 5.2 says.
std::string frame(char first, size_t length, bool masked) {
  std::string bytes(1, first);
  const int mask_bit = masked ? 0x80 : 0;
  const auto add_length = [&](int size) {
    for (int i = size - 1; i >= 0; --i) bytes += static_cast<char>(length >> (8 * i) & 0xff);
  };
  if (length < 126) {
    bytes += static_cast<char>(mask_bit | static_cast<int>(length));
  } else if (length < 65'536) {
    bytes += static_cast<char>(mask_bit | 126);
    add_length(2);
  } else {
    bytes += static_cast<char>(mask_bit | 127);
    add_length(8);
  }
  if (masked) bytes += "mask";
  return bytes + std::string(length, '\x80');
}

TEST(FrameMeter, CountsFramesOfEveryLengthWhereverTheyAreCut) {
  std::mt19937 random(test::seed());
  std::string bytes;
  size_t frames = 0;
  for (const size_t length : {size_t{0}, size_t{1}, size_t{125}, size_t{126}, size_t{65'535}, size_t{65'536}})
    for (const char first : {'\x82', '\x00', '\x89'})
      for (const bool masked : {true, false}) {
        bytes += frame(first, length, masked);
        ++frames;
      }
  for (int round = 0; round < 50; ++round) {
    FrameMeter meter;
    size_t counted = 0;
    for (size_t at = 0; at < bytes.size();) {
      const size_t most = random() % 3 == 0 ? 5'000 : 7;
      const size_t piece = std::min<size_t>(1 + random() % most, bytes.size() - at);
      counted += count(meter, bytes.substr(at, piece));
      at += piece;
    }
    EXPECT_EQ(counted, frames);
  }
}

TEST(FrameMeter, EmptyFragmentsAreFrames) {
  FrameMeter meter;
  std::string fragments;
  for (int i = 0; i < 1000; ++i) fragments += frame('\x00', 0, true);
  EXPECT_EQ(count(meter, fragments), 1000u);
}

TEST(FrameMeter, LengthsBeyondMemoryHideNothingButThemselves) {
  FrameMeter meter;
  EXPECT_EQ(count(meter, std::string("\x82\xff\xff\xff\xff\xff\xff\xff\xff\xff") + "mask"), 1u);
  EXPECT_EQ(count(meter, std::string(100'000, '\x80')), 0u);
}

}  // namespace
}  // namespace ream::net
