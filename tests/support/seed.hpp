#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <random>
#include <stdexcept>
#include <string>

namespace ream::test {

/// The seed of every test that draws at random: REAM_TEST_SEED, or else one that is drawn when a program
/// first asks and printed once, as "REAM_TEST_SEED=123", which is how it is given back:
///     REAM_TEST_SEED=123 build/unit_stream --gtest_filter=Codec.*
/// Each test starts a generator of its own from it (`std::mt19937 random(test::seed());`), so that a test
/// draws the same whichever others run before it. It stands in the XML results, too, as the property "seed".
inline uint32_t seed() {
  static const uint32_t value = [] {
    const char* given = std::getenv("REAM_TEST_SEED");
    const std::string text = given == nullptr ? "" : given;
    if (text.find_first_not_of("0123456789") != std::string::npos || text.size() > 10)
      throw std::runtime_error("REAM_TEST_SEED is no whole number below 2^32: " + text);
    const uint32_t chosen = text.empty() ? std::random_device{}() : static_cast<uint32_t>(std::stoull(text));
    std::cout << "REAM_TEST_SEED=" << chosen << std::endl;
    return chosen;
  }();
  testing::Test::RecordProperty("seed", std::to_string(value));
  return value;
}

}  // namespace ream::test
