#include "score/contact_spread.hpp"

#include <gtest/gtest.h>

namespace ream::score {
namespace {

record::TickReport moment(bool engaged, bool paused = false) {
  record::TickReport report;
  report.engaged = engaged;
  report.paused = paused;
  return report;
}

std::optional<double> spread_of(const ContactSpread& spread) {
  MetricResults results;
  spread.write(results);
  return results.value("contact_spread_mm");
}

TEST(ContactSpread, IsOfPlacesInContactOnly) {
  ContactSpread spread;
  spread.add(moment(false), {100.0, 0.0, 0.0});
  EXPECT_FALSE(spread_of(spread)) << "nothing was touched";
  spread.add(moment(true), {1.0, 2.0, 3.0});
  EXPECT_EQ(spread_of(spread), 0.0);
  spread.add(moment(true, true), {50.0, 0.0, 0.0});
  spread.add(moment(false), {-50.0, 0.0, 0.0});
  spread.add(moment(true), {3.0, 5.0, 9.0});
  EXPECT_DOUBLE_EQ(*spread_of(spread), 7.0) << "2, 3 and 6 mm";
  spread.add(moment(true), {2.0, 3.0, 4.0});
  EXPECT_DOUBLE_EQ(*spread_of(spread), 7.0) << "between the others";
}

}  // namespace
}  // namespace ream::score
