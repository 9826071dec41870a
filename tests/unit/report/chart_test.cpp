#include "report/chart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "report/canvas.hpp"
#include "support/seed.hpp"

namespace ream::report {
namespace {

/// Keeps everything that is drawn.
class KeepingCanvas final : public Canvas {
 public:
  struct Words {
    Place at;
    std::string words;
    Lettering lettering;
  };
  void fill(std::span<const Place> polygon, const Ink&) override {
    fills.emplace_back(polygon.begin(), polygon.end());
  }
  void line(std::span<const Place> path, const Stroke& stroke) override {
    (stroke.dashed ? dashed : lines).emplace_back(path.begin(), path.end());
  }
  void text(const Place& at, const std::string& words, const Lettering& lettering) override {
    texts.push_back({at, words, lettering});
  }

  std::vector<std::vector<Place>> fills, lines, dashed;
  std::vector<Words> texts;
};

Chart ramp() {
  Chart chart;
  chart.x_name = "time, s";
  chart.y_name = "N";
  chart.x_max = 10.0;
  chart.y_max = 100.0;
  Curve curve;
  curve.parts = {{{0.0, 0.0, 0.0}, {10.0, 100.0, 100.0}}};
  chart.curves.push_back(curve);
  return chart;
}

TEST(RoundNumbers, AreRoundAscendAndFit) {
  std::mt19937 random(test::seed(51));
  std::uniform_real_distribution<double> exponent(-4.0, 5.0), part(-1.0, 1.0);
  for (int round = 0; round < 500; ++round) {
    const double min = part(random) * std::pow(10.0, exponent(random));
    const double max = min + std::pow(10.0, exponent(random)) * (0.1 + std::abs(part(random)));
    const auto numbers = round_numbers(min, max, 6);
    EXPECT_GE(numbers.size(), 2u) << "seed 51: " << min << " to " << max;
    EXPECT_LE(numbers.size(), 8u) << "seed 51: " << min << " to " << max;
    const double slack = 1e-6 * (max - min);
    EXPECT_GE(numbers.front(), min - slack);
    EXPECT_LE(numbers.back(), max + slack);
    EXPECT_TRUE(std::is_sorted(numbers.begin(), numbers.end()));
  }
  EXPECT_EQ(round_numbers(0.0, 100.0, 5), (std::vector<double>{0, 20, 40, 60, 80, 100}));
  EXPECT_EQ(round_numbers(0.5, 3.5, 8, true), (std::vector<double>{1, 2, 3}));
  EXPECT_TRUE(round_numbers(1.0, 1.0, 5).empty());
  EXPECT_TRUE(round_numbers(0.0, NAN, 5).empty());
}

TEST(DrawChart, ValuesStandAtTheirNumbers) {
  KeepingCanvas canvas;
  draw_chart(ramp(), canvas, {100.0, 200.0}, 400.0, 150.0);
  const auto label = [&](const std::string& words, Anchor anchor) {
    const auto found = std::find_if(canvas.texts.begin(), canvas.texts.end(), [&](const auto& text) {
      return text.words == words && text.lettering.anchor == anchor;
    });
    EXPECT_NE(found, canvas.texts.end()) << words;
    return found->at;
  };
  // The longest line that is not a straight rule of the grid is the curve.
  const auto curve = std::find_if(canvas.lines.begin(), canvas.lines.end(), [](const auto& path) {
    return path.front().x != path.back().x && path.front().y != path.back().y;
  });
  ASSERT_NE(curve, canvas.lines.end());
  EXPECT_NEAR(curve->front().y, label("0", Anchor::right).y, 3.0);
  EXPECT_NEAR(curve->back().y, label("100", Anchor::right).y, 3.0);
  EXPECT_NEAR(curve->front().x, label("0", Anchor::middle).x, 1e-9);
  EXPECT_NEAR(curve->back().x, label("10", Anchor::middle).x, 1e-9);
  for (const auto& text : canvas.texts) {
    EXPECT_GE(text.at.x, 100.0) << text.words;
    EXPECT_LE(text.at.x, 500.0) << text.words;
    EXPECT_LE(text.at.y, 350.0) << text.words;
  }
}

TEST(DrawChart, WhatIsBeyondTheAxesStaysInside) {
  Chart chart = ramp();
  chart.curves[0].parts = {{{-5.0, -50.0, -50.0}, {20.0, 900.0, 900.0}}};
  chart.moments.push_back({99.0, "1"});
  chart.levels.push_back({500.0, "far"});
  KeepingCanvas canvas;
  draw_chart(chart, canvas, {}, 400.0, 150.0);
  for (const auto* paths : {&canvas.lines, &canvas.dashed, &canvas.fills})
    for (const auto& path : *paths)
      for (const Place& place : path) {
        EXPECT_GE(place.x, 0.0);
        EXPECT_LE(place.x, 400.0);
        EXPECT_GE(place.y, 0.0);
        EXPECT_LE(place.y, 150.0);
      }
}

TEST(DrawChart, AnEmptyChartHasAxes) {
  Chart chart = ramp();
  chart.curves.clear();
  KeepingCanvas canvas;
  draw_chart(chart, canvas, {}, 400.0, 150.0);
  EXPECT_GT(canvas.texts.size(), 5u);
}

TEST(SvgCanvas, SaysItsWordsSafely) {
  SvgCanvas canvas;
  canvas.text({1.0, 2.0}, "<a & \"b\">", {});
  const std::string svg = canvas.svg(10.0, 20.0, "it's <this>");
  EXPECT_NE(svg.find("&lt;a &amp; &quot;b&quot;&gt;</text>"), std::string::npos);
  EXPECT_NE(svg.find("aria-label=\"it&#39;s &lt;this&gt;\""), std::string::npos);
  EXPECT_EQ(svg.find("<a"), std::string::npos);
}

}  // namespace
}  // namespace ream::report
