#pragma once
#include <functional>
#include <string>
#include <vector>

namespace ream::bench {

/// One measured figure. `ratio` is goal / ours where smaller is better (1 or more: met); 0 without a goal.
struct Row {
  std::string suite, name;
  double ours = 0.0;
  double baseline = 0.0;  ///< 0: none
  std::string unit;
  double goal = 0.0;  ///< 0: none; a row is met when ours <= goal
};

struct Options {
  bool baselines = false;
};

std::vector<Row> collide_suite(const Options& options);
std::vector<Row> surface_suite(const Options& options);

}  // namespace ream::bench
