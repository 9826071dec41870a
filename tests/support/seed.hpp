#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>

namespace ream::test {

/// REAM_TEST_SEED, the one seed of all tests that draw at random; none when it is not set.
///     REAM_TEST_SEED=123 build/unit_stream --gtest_filter=Codec.*
inline std::optional<uint32_t> given_seed() {
  static const std::optional<uint32_t> value = []() -> std::optional<uint32_t> {
    const char* given = std::getenv("REAM_TEST_SEED");
    const std::string text = given == nullptr ? "" : given;
    if (text.find_first_not_of("0123456789") != std::string::npos || text.size() > 10)
      throw std::runtime_error("REAM_TEST_SEED is no whole number below 2^32: " + text);
    if (text.empty()) return std::nullopt;
    return static_cast<uint32_t>(std::stoull(text));
  }();
  return value;
}

/// The seed of a test whose limits hold for this data and for nearly all others: REAM_TEST_SEED, or else
/// `default_seed`. Stands in the XML results as the property "seed".
inline uint32_t seed(uint32_t default_seed) {
  const uint32_t value = given_seed().value_or(default_seed);
  testing::Test::RecordProperty("seed", std::to_string(value));
  return value;
}

/// The seed of a test that must hold for any data: REAM_TEST_SEED, or else one that is drawn when a program
/// first asks and printed once, as "REAM_TEST_SEED=123", which is how it is given back. Each test starts a
/// generator of its own from it (`std::mt19937 random(test::seed());`), so that a test draws the same
/// whichever others run before it.
inline uint32_t seed() {
  static const uint32_t drawn = [] {
    const uint32_t value = given_seed() ? *given_seed() : std::random_device{}();
    std::cout << "REAM_TEST_SEED=" << value << std::endl;
    return value;
  }();
  return seed(drawn);
}

}  // namespace ream::test
