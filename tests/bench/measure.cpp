#include "bench/measure.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/clock.hpp"

namespace ream::bench {
namespace {

/// As many as a tool that comes to rest gets before it is felt.
constexpr size_t warm_up_poses = 50;

}  // namespace

double percentile_of(std::vector<double>& values, double fraction) {
  if (values.empty()) return 0.0;
  const auto last = static_cast<double>(values.size() - 1);
  const auto rank = static_cast<std::ptrdiff_t>(std::floor(fraction * last));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<size_t>(rank)];
}

double Samples::percentile(double fraction) const {
  std::vector<double> all;
  for (const auto& round : us) all.insert(all.end(), round.begin(), round.end());
  return percentile_of(all, fraction);
}

double Samples::mean_us() const {
  double sum = 0.0;
  for (size_t pose = 0; pose < found.size(); ++pose) {
    std::vector<double> of_pose;
    for (const auto& round : us) of_pose.push_back(round[pose]);
    sum += percentile_of(of_pose, 0.25);
  }
  return found.empty() ? 0.0 : sum / static_cast<double>(found.size());
}

double Samples::mean_found() const {
  return found.empty() ? 0.0
                       : static_cast<double>(std::accumulate(found.begin(), found.end(), int64_t{0})) /
                             static_cast<double>(found.size());
}

std::vector<Samples> measure_in_turns(std::span<const Contender> contenders,
                                      std::span<const QuantisedPose> poses, int rounds) {
  std::vector<Samples> all;
  for (const Contender& c : contenders) all.push_back({c.name, {}, std::vector<int64_t>(poses.size())});
  for (int round = 0; round < rounds; ++round)
    for (size_t c = 0; c < contenders.size(); ++c) {
      for (const QuantisedPose& pose : poses.first(std::min(warm_up_poses, poses.size())))
        contenders[c].contact(pose);
      std::vector<double>& us = all[c].us.emplace_back(poses.size());
      for (size_t i = 0; i < poses.size(); ++i) {
        const auto start = SteadyClock::now();
        all[c].found[i] = contenders[c].contact(poses[i]);
        us[i] = elapsed_us(start);
      }
    }
  return all;
}

}  // namespace ream::bench
