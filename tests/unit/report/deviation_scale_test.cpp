#include "report/deviation_scale.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "score/deviation.hpp"

namespace ream::report {
namespace {

bool same(const render::VertexColour& a, const render::VertexColour& b) {
  return a.red == b.red && a.green == b.green && a.blue == b.blue && a.hatch == b.hatch;
}

TEST(DeviationScale, ClassesAscendAndCoverEverything) {
  const auto& classes = deviation_classes();
  for (size_t i = 1; i < classes.size(); ++i) EXPECT_LT(classes[i - 1].up_to, classes[i].up_to);
  EXPECT_GT(classes.back().up_to, score::deviation_range_mm);
  for (int code = -127; code <= 127; ++code) {
    const double mm = score::deviation_mm(static_cast<int8_t>(code));
    const auto colour = deviation_colour(static_cast<int8_t>(code));
    EXPECT_EQ(colour.hatch == 255, mm > 0.25) << mm << ": too deep, and only that, is hatched";
  }
  EXPECT_TRUE(same(deviation_colour(0), deviation_colour(-7)));
  EXPECT_FALSE(same(deviation_colour(0), deviation_colour(9)));
  EXPECT_FALSE(same(deviation_colour(score::deviation_unknown), deviation_colour(-127)));
}

/// Relative luminance, sRGB.
double luminance(const render::VertexColour& c) {
  const auto linear = [](uint8_t level) { return std::pow(level / 255.0, 2.2); };
  return 0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue);
}

TEST(DeviationScale, FartherIsDarkerOnEitherSide) {
  const auto& classes = deviation_classes();
  for (size_t i = 0; i < 3; ++i) EXPECT_LT(luminance(classes[i].colour), luminance(classes[i + 1].colour));
  for (size_t i = 3; i + 1 < classes.size(); ++i)
    EXPECT_GT(luminance(classes[i].colour), luminance(classes[i + 1].colour));
}

TEST(WallScale, ThinnerIsDarkerAndTheThinnestIsHatched) {
  const auto& classes = wall_classes();
  for (size_t i = 0; i + 1 < classes.size(); ++i) {
    EXPECT_LT(classes[i].up_to, classes[i + 1].up_to);
    EXPECT_LT(luminance(classes[i].colour), luminance(classes[i + 1].colour));
  }
  const int8_t codes[] = {0, 8, 9, 127, score::deviation_unknown};
  const auto colours = wall_colours(codes);
  EXPECT_TRUE(same(colours[0], colours[1])) << "up to 2 mm";
  EXPECT_EQ(colours[1].hatch, 255);
  EXPECT_TRUE(same(colours[2], classes[1].colour));
  EXPECT_TRUE(same(colours[3], classes.back().colour));
  EXPECT_TRUE(same(colours[4], deviation_colour(score::deviation_unknown)));
  EXPECT_NE(wall_classes_in_words().find("2 to 5 mm"), std::string::npos);
}

/// What red-green blindness leaves of a colour, roughly: its luminance and its blue against yellow.
TEST(DeviationScale, SidesAreToldApartByBlueAlone) {
  for (const DeviationClass& each : deviation_classes()) {
    const int blueness = 2 * each.colour.blue - each.colour.red - each.colour.green;
    if (each.up_to < -0.2) {
      EXPECT_LT(blueness, -50) << each.words;
    } else if (each.up_to > 0.3) {
      EXPECT_GT(blueness, 25) << each.words;
    }
  }
}

}  // namespace
}  // namespace ream::report
