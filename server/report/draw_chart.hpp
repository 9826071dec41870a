#pragma once
#include <vector>

#include "report/canvas.hpp"
#include "report/chart.hpp"

namespace ream::report {

/// Draws a chart, without its title, into a box whose top left corner is `at`.
void draw_chart(const Chart& chart, Canvas& canvas, const Place& at, double width, double height);

/// Round numbers within [min, max], ascending, about `wanted` of them (1, 2 or 5 times a power of ten apart).
/// Only whole ones if `whole`. Empty when max <= min or a number is not finite.
std::vector<double> round_numbers(double min, double max, int wanted, bool whole = false);

}  // namespace ream::report
