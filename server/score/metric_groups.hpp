#pragma once
#include <span>

#include "score/metric_catalogue.hpp"

namespace ream::score {

// The catalogue in three parts, each in a source of its own.
std::span<const Metric> alignment_metrics();
std::span<const Metric> bone_metrics();
std::span<const Metric> handling_metrics();

constexpr Band only_reported{};
constexpr Band at_most(double pass, double warn) { return {Better::less, pass, warn, 0.0}; }
constexpr Band at_least(double pass, double warn) { return {Better::more, pass, warn, 0.0}; }
constexpr Band between(double low, double high) { return {Better::between, high, high, low}; }

}  // namespace ream::score
