#pragma once
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "score/benchmark.hpp"
#include "score/rubric_score.hpp"

namespace ream::score {

/// How the densities of both groups are had from their values: each a normal distribution with the group's
/// mean and standard deviation (n - 1), or a Gaussian kernel on each value, with Silverman's bandwidth 0.9
/// min(sd, IQR / 1.34) n^(-1/5).
enum class Density { normal, kernel };

/// A pass mark by the contrasting-groups method: where the densities of novices and experts cross between the
/// groups' means. The side of the experts passes; the mark itself does.
struct GroupCut {
  Density density = Density::normal;
  double cut = 0.0;
  bool experts_higher = true;
  double novice_mean = 0.0, novice_sd = 0.0, expert_mean = 0.0, expert_sd = 0.0;
  int novices = 0, experts = 0;
  int novices_passing = 0;  ///< false positives
  int experts_failing = 0;  ///< false negatives
  /// What the densities say of the same: shares of each group on the wrong side.
  double expected_novices_passing = 0.0, expected_experts_failing = 0.0;

  bool passes(double value) const { return experts_higher ? value >= cut : value <= cut; }
};

/// Values of one metric or of the points, finite. Where the densities cross more than once between the means,
/// the crossing with the fewest expected on the wrong side is taken. Errors: invalid_input when a group has
/// fewer than 3 values or no spread, or when the densities do not cross between the means.
GroupCut contrasting_groups(std::span<const double> novices, std::span<const double> experts,
                            Density density);

/// "normal", "kernel".
std::string_view to_text(Density density);

/// Cuts of the points by a rubric ("points") and of every metric that has an aim and that both groups have.
/// Where groups cannot be cut, the entry has `error` in place of figures.
nlohmann::json group_cuts_json(const std::vector<EndedSession>& novices,
                               const std::vector<EndedSession>& experts, const Rubric& rubric,
                               Density density);

/// Error invalid_input for other words than normal and kernel.
Density density_from_text(const std::string& text);

}  // namespace ream::score
