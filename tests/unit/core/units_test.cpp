#include "core/units.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"

namespace ream {
namespace {

TEST(Units, PiIsTheNearestDouble) { EXPECT_EQ(pi, std::acos(-1.0)); }

TEST(Units, ConvertBothWays) {
  EXPECT_DOUBLE_EQ(radians_from_degrees(180.0), pi);
  EXPECT_DOUBLE_EQ(degrees_from_radians(radians_from_degrees(-7.25)), -7.25);
  EXPECT_DOUBLE_EQ(rad_s_from_rpm(60.0), 2.0 * pi);
}

TEST(ExitCode, IsTwoForUsageAndOneForTheRest) {
  EXPECT_EQ(exit_code(ErrorKind::usage), 2);
  for (const ErrorKind kind : {ErrorKind::invalid_input, ErrorKind::not_found, ErrorKind::conflict,
                               ErrorKind::unavailable, ErrorKind::io})
    EXPECT_EQ(exit_code(kind), 1);
}

}  // namespace
}  // namespace ream
