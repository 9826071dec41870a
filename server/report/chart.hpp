#pragma once
#include <string>
#include <vector>

#include "report/canvas.hpp"

namespace ream::report {

/// What lies over one stretch of the x axis: a line where low and high are equal.
struct CurvePoint {
  double x = 0.0, low = 0.0, high = 0.0;
};

/// Values in order of x; gaps part it. Shown as an area from low to high with a line along both.
struct Curve {
  std::vector<std::vector<CurvePoint>> parts;
  bool dots = false;  ///< every point is a value of its own
};

/// A range of y to stay in.
struct TargetRange {
  double low = 0.0, high = 0.0;
  std::string words;
};

/// A value of y that means something.
struct Level {
  double y = 0.0;
  std::string words;
};

/// A place on the x axis that means something; the words stand at the top.
struct Moment {
  double x = 0.0;
  std::string words;
};

/// A stretch of the x axis, drawn as a bar under the curve.
struct Stretch {
  double from = 0.0, to = 0.0;
};

struct Chart {
  std::string title;
  std::string alt_text;  ///< what is to be seen, for those who cannot see it
  std::string x_name, y_name;
  double x_min = 0.0, x_max = 1.0, y_min = 0.0, y_max = 1.0;
  std::vector<TargetRange> ranges;
  std::vector<Level> levels;
  std::vector<Curve> curves;
  std::vector<Moment> moments;
  std::vector<Stretch> stretches;
  std::string stretches_name;  ///< what the bars are
  bool whole_x = false;        ///< x counts things
};

/// Draws a chart, without its title, into a box whose top left corner is `at`.
void draw_chart(const Chart& chart, Canvas& canvas, const Place& at, double width, double height);

/// Round numbers within [min, max], ascending, about `count` of them (1, 2 or 5 times a power of ten apart).
/// Only whole ones if `whole`. Empty when max <= min or a number is not finite.
std::vector<double> round_numbers(double min, double max, int count, bool whole = false);

}  // namespace ream::report
