#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "geometry/pose.hpp"

namespace ream::bench {

/// Something that finds contact at a pose, its broad phase included; returns how many points (or voxels) it
/// found.
struct Contender {
  std::string name;
  std::function<int64_t(const QuantisedPose&)> contact;
};

/// Times of one contender, `us[round][pose]`, and what it found.
struct Samples {
  std::string name;
  std::vector<std::vector<double>> us;
  std::vector<int64_t> found;  ///< of each pose

  double percentile(double fraction) const;
  /// Mean over the poses of each pose's lower quartile over the rounds: what else the machine does only adds
  /// time.
  double mean_us() const;
  double mean_found() const;
};

/// The rank nearest below; reorders `values`. Zero of nothing.
double percentile_of(std::vector<double>& values, double fraction);

/// Contenders take turns round by round, so that what else the machine does falls on all of them alike. A
/// turn starts with poses that are not timed.
std::vector<Samples> measure_in_turns(std::span<const Contender> contenders,
                                      std::span<const QuantisedPose> poses, int rounds);

}  // namespace ream::bench
