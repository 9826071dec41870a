#pragma once
#include <span>
#include <vector>

#include "score/group_cut.hpp"

namespace ream::score {

/// Mean and standard deviation (n - 1) of at least two values.
struct Spread {
  double mean = 0.0, sd = 0.0;
};
Spread spread_of(std::span<const double> values);

/// Density of one group of values; see Density for both kinds.
class GroupDensity {
 public:
  /// At least two values that are not all equal.
  GroupDensity(std::span<const double> values, Density kind);

  double at(double x) const;
  /// Share of the group below x.
  double below(double x) const;

 private:
  std::vector<double> centres_;
  double width_ = 1.0;  ///< standard deviation of the normal around each centre
};

}  // namespace ream::score
