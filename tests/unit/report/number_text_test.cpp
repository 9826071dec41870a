#include "report/number_text.hpp"

#include <gtest/gtest.h>

namespace ream::report {
namespace {

TEST(NumberWords, HaveATrueMinusAndNoNegativeNothing) {
  EXPECT_EQ(decimal(-1.25, 1), "\u22121.2");
  EXPECT_EQ(decimal(-0.04, 1), "0.0");
  EXPECT_EQ(decimal(-0.06, 1), "\u22120.1");
  EXPECT_EQ(decimal(12.0, 0), "12");
  EXPECT_EQ(shortest(-2.5), "\u22122.5");
  EXPECT_EQ(shortest(5.0), "5");
}

TEST(NumberWords, ArePrintedWithTheirUnit) {
  EXPECT_EQ(with_unit(1.234, "mm"), "1.23\u00a0mm");
  EXPECT_EQ(with_unit(812.4, "mm3"), "812\u00a0mm\u00b3");
  EXPECT_EQ(with_unit(-3.26, "deg"), "\u22123.3\u00b0");
  EXPECT_EQ(with_unit(91.4, "%"), "91\u00a0%");
  EXPECT_EQ(with_unit(3.0, ""), "3");
  EXPECT_EQ(with_unit(-1.4142, ""), "\u22121.41");
}

TEST(NumberWords, TellTimesAsPeopleDo) {
  EXPECT_EQ(duration_text(4.06), "4.1\u00a0s");
  EXPECT_EQ(duration_text(37.2), "37\u00a0s");
  EXPECT_EQ(duration_text(125.4), "2\u00a0min 05\u00a0s");
  EXPECT_EQ(date_text("2026-01-31T09:05:59Z"), "31 January 2026, 09:05 UTC");
  EXPECT_EQ(date_text("some day"), "some day");
  EXPECT_EQ(date_text("2026-13-31T09:05:59Z"), "2026-13-31T09:05:59Z");
}

}  // namespace
}  // namespace ream::report
