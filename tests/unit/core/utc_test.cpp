#include "core/utc.hpp"

#include <gtest/gtest.h>

#include "support/expect_error.hpp"

namespace ream {
namespace {

TEST(Utc, GoesThereAndBack) {
  for (const char* text : {"1970-01-01T00:00:00Z", "2024-02-29T23:59:59Z", "2026-01-31T12:00:00Z"})
    EXPECT_EQ(utc_text(utc_moment(text)), text);
  EXPECT_EQ(utc_moment("1970-01-02T00:00:01Z").time_since_epoch(), std::chrono::seconds(86401));
}

TEST(Utc, LaterMomentsAreGreaterTexts) {
  const UtcMoment noon = utc_moment("2026-01-31T12:00:00Z");
  for (const auto later : {std::chrono::hours(1), std::chrono::hours(24), std::chrono::hours(24 * 400)})
    EXPECT_LT(utc_text(noon), utc_text(noon + later));
}

TEST(Utc, OtherTextsAreRefused) {
  for (const char* text : {"", "2026-01-31", "2026-01-31T12:00:00", "2026-01-31T12:00:00Zx",
                           "2026-02-30T12:00:00Z", "2026-1-31T12:00:00Z", "2026-01-31T25:00:00Z", "tomorrow"})
    test::expect_error(ErrorKind::invalid_input, text, [&] { utc_moment(text); });
}

}  // namespace
}  // namespace ream
