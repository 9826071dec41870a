#pragma once
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace ream::bench {

/// Which side of its goal a figure must be on.
enum class Goal { at_most, at_least };

/// One measured figure.
struct Row {
  std::string suite, name;
  double ours = 0.0;
  double baseline = 0.0;  ///< 0: none
  std::string unit;
  double goal = 0.0;  ///< 0: none
  Goal goal_is = Goal::at_most;
};

struct Options {
  bool baselines = false;
  std::ostream* tables = nullptr;  ///< where a suite prints tables for people as it measures; null: nowhere
};

std::vector<Row> collide_suite(const Options& options);

}  // namespace ream::bench
