#pragma once
#include <cstdint>
#include <vector>

#include "force/oblique_cutting.hpp"

namespace ream::force {

/// Thrust and torque of all lips against the feed per revolution, for a specific cutting coefficient of 1
/// N/mm^2: thrust in N per N/mm^2 (mm^2), torque in N mm per N/mm^2 (mm^3). Linear between its rows and
/// beyond the last one; the first is all zero. Reading it takes comparison and + - x / only.
class FeedTable {
 public:
  /// Feeds and thrusts ascend strictly from 0; at least two rows.
  FeedTable(std::vector<double> feed_mm, std::vector<double> thrust_mm2, std::vector<double> torque_mm3);

  double thrust_mm2_at(double feed_mm) const noexcept;
  double torque_mm3_at(double feed_mm) const noexcept;
  /// The feed per revolution that takes this thrust.
  double feed_mm_at(double thrust_mm2) const noexcept;
  /// Of every bit in the table.
  uint64_t hash() const noexcept { return hash_; }

 private:
  std::vector<double> feed_mm_, thrust_mm2_, torque_mm3_;
  uint64_t hash_ = 0;
};

/// From 0 and 0.1 um a revolution to more than 5 mm in steps of a sixteenth, so that power laws are as true
/// at small feeds as at large ones. Error invalid_input when the lip is empty or thrust does not rise with
/// feed.
FeedTable make_feed_table(const Lip& lip, const CuttingCoefficients& coefficients, double spindle_rad_s);

}  // namespace ream::force
