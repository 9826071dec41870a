#include "report/chart.hpp"

#include <algorithm>
#include <cmath>

#include "report/number_text.hpp"

namespace ream::report {
namespace {

constexpr double left_margin = 34.0, right_margin = 62.0, top_margin = 12.0, bottom_margin = 26.0;
constexpr double bar_height = 4.0, label_size = 7.0;
constexpr Ink band_ink{0.90, 0.93, 0.96}, curve_ink{0.12, 0.30, 0.48}, area_ink{0.62, 0.74, 0.85};
constexpr Ink moment_ink{0.55, 0.25, 0.05};

/// From values to paper.
class Scale {
 public:
  Scale(const Chart& chart, const Place& at, double width, double height)
      : chart_(chart),
        left_(at.x + left_margin),
        right_(at.x + width - right_margin),
        top_(at.y + top_margin),
        bottom_(at.y + height - bottom_margin - (chart.stretches_name.empty() ? 0.0 : bar_height + 3.0)) {}

  double x(double value) const { return left_ + share(value, chart_.x_min, chart_.x_max) * (right_ - left_); }
  double y(double value) const {
    return bottom_ - share(value, chart_.y_min, chart_.y_max) * (bottom_ - top_);
  }
  double left() const { return left_; }
  double right() const { return right_; }
  double top() const { return top_; }
  double bottom() const { return bottom_; }

 private:
  static double share(double value, double min, double max) {
    return max > min ? std::clamp((value - min) / (max - min), 0.0, 1.0) : 0.0;
  }

  const Chart& chart_;
  double left_, right_, top_, bottom_;
};

void draw_grid(const Chart& chart, Canvas& canvas, const Scale& scale, double paper_bottom) {
  const double steps_y = (scale.bottom() - scale.top()) / 17.0;
  const auto ys = round_numbers(chart.y_min, chart.y_max, std::max(2, static_cast<int>(steps_y)));
  for (const double value : ys) {
    canvas.straight({scale.left(), scale.y(value)}, {scale.right(), scale.y(value)},
                    {0.4, grey(0.86), false});
    canvas.text({scale.left() - 4.0, scale.y(value) + 2.5}, shortest(value),
                {label_size, grey(0.25), Anchor::right, false, false});
  }
  for (const double value : round_numbers(chart.x_min, chart.x_max, 8, chart.whole_x)) {
    canvas.straight({scale.x(value), scale.bottom()}, {scale.x(value), scale.bottom() + 2.5},
                    {0.6, grey(0.4), false});
    canvas.text({scale.x(value), paper_bottom - bottom_margin + 10.0}, shortest(value),
                {label_size, grey(0.25), Anchor::middle, false, false});
  }
  canvas.straight({scale.left(), scale.bottom()}, {scale.right(), scale.bottom()}, {0.6, grey(0.4), false});
}

void draw_names(const Chart& chart, Canvas& canvas, const Scale& scale, const Place& at, double height) {
  canvas.text({0.5 * (scale.left() + scale.right()), at.y + height - 4.0}, chart.x_name,
              {label_size, grey(0.25), Anchor::middle, false, false});
  canvas.text({at.x + 8.0, 0.5 * (scale.top() + scale.bottom())}, chart.y_name,
              {label_size, grey(0.25), Anchor::middle, false, true});
}

void draw_ranges(const Chart& chart, Canvas& canvas, const Scale& scale) {
  for (const TargetRange& range : chart.ranges) {
    canvas.fill_box({scale.left(), scale.y(range.high)}, {scale.right(), scale.y(range.low)}, band_ink);
    for (const double edge : {range.low, range.high})
      canvas.straight({scale.left(), scale.y(edge)}, {scale.right(), scale.y(edge)},
                      {0.5, grey(0.55), false});
  }
}

void draw_limits(const Chart& chart, Canvas& canvas, const Scale& scale) {
  for (const TargetRange& range : chart.ranges)
    canvas.text({scale.right() + 4.0, scale.y(0.5 * (range.low + range.high)) + 2.5}, range.words,
                {label_size, grey(0.3), Anchor::left, false, false});
  for (const Level& level : chart.levels) {
    canvas.straight({scale.left(), scale.y(level.y)}, {scale.right(), scale.y(level.y)},
                    {0.7, grey(0.3), true});
    canvas.text({scale.right() + 4.0, scale.y(level.y) + 2.5}, level.words,
                {label_size, grey(0.3), Anchor::left, false, false});
  }
}

void draw_curve(const Curve& curve, Canvas& canvas, const Scale& scale) {
  for (const auto& part : curve.parts) {
    std::vector<Place> high, low;
    bool is_area = false;
    for (const CurvePoint& point : part) {
      high.push_back({scale.x(point.x), scale.y(point.high)});
      low.push_back({scale.x(point.x), scale.y(point.low)});
      is_area = is_area || point.high > point.low;
    }
    if (is_area) {
      std::vector<Place> outline = high;
      outline.insert(outline.end(), low.rbegin(), low.rend());
      canvas.fill(outline, area_ink);
      canvas.line(low, {0.6, curve_ink, false});
    }
    canvas.line(high, {is_area ? 0.6 : 1.0, curve_ink, false});
    if (!curve.dots) continue;
    for (const Place& dot : high)
      canvas.fill_box({dot.x - 1.8, dot.y - 1.8}, {dot.x + 1.8, dot.y + 1.8}, curve_ink);
  }
}

void draw_moments(const Chart& chart, Canvas& canvas, const Scale& scale) {
  for (const Moment& moment : chart.moments) {
    canvas.straight({scale.x(moment.x), scale.top() - 2.0}, {scale.x(moment.x), scale.bottom()},
                    {0.6, moment_ink, true});
    canvas.text({scale.x(moment.x), scale.top() - 4.0}, moment.words,
                {label_size, moment_ink, Anchor::middle, true, false});
  }
}

void draw_stretches(const Chart& chart, Canvas& canvas, const Scale& scale) {
  if (chart.stretches_name.empty()) return;
  const double top = scale.bottom() + 3.0;
  canvas.text({scale.left() - 4.0, scale.bottom() + 10.0}, chart.stretches_name,
              {label_size - 1.0, grey(0.25), Anchor::right, false, false});
  for (const Stretch& stretch : chart.stretches)
    canvas.fill_box({scale.x(stretch.from), top},
                    {std::max(scale.x(stretch.to), scale.x(stretch.from) + 0.4), top + bar_height},
                    grey(0.35));
}

}  // namespace

std::vector<double> round_numbers(double min, double max, int count, bool whole) {
  std::vector<double> numbers;
  if (!std::isfinite(min) || !std::isfinite(max) || !(max > min) || count < 1) return numbers;
  const double rough = (max - min) / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough * 0.999) {
      step = factor * power;
      break;
    }
  if (whole) step = std::max(1.0, std::floor(step + 0.5));
  const double first = std::ceil(min / step - 1e-9), last = std::floor(max / step + 1e-9);
  const double decimals = std::pow(10.0, std::max(0.0, -std::floor(std::log10(step))));
  for (double i = first; i <= last; ++i) {
    const double value = std::floor(i * step * decimals + 0.5) / decimals;
    numbers.push_back(value == 0.0 ? 0.0 : value);
  }
  return numbers;
}

void draw_chart(const Chart& chart, Canvas& canvas, const Place& at, double width, double height) {
  const Scale scale(chart, at, width, height);
  draw_ranges(chart, canvas, scale);
  draw_grid(chart, canvas, scale, at.y + height);
  for (const Curve& curve : chart.curves) draw_curve(curve, canvas, scale);
  draw_limits(chart, canvas, scale);
  draw_moments(chart, canvas, scale);
  draw_stretches(chart, canvas, scale);
  draw_names(chart, canvas, scale, at, height);
}

}  // namespace ream::report
