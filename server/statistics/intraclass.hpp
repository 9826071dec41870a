#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "statistics/estimate.hpp"

namespace ream::statistics {

/// What the raters say of one subject, in the same order for all subjects; empty where one says nothing.
using RatingRow = std::vector<std::optional<double>>;

/// Rows of which every rater says something, and how many others there are.
struct CompleteRatings {
  std::vector<std::vector<double>> rows;
  size_t dropped = 0;
};
CompleteRatings complete_rows(const std::vector<RatingRow>& ratings);

/// Agreement of raters who all rate all subjects: two-way random effects, absolute agreement. ICC(2,1) is of
/// one rater, ICC(2,k) of the mean of all k. Shrout & Fleiss 1979, "Intraclass correlations: uses in
/// assessing rater reliability", Psychol Bull 86; McGraw & Wong 1996, Psychol Methods 1, who call them
/// ICC(A,1) and ICC(A,k). Both may be below 0.
struct IntraclassCorrelation {
  size_t subjects = 0, raters = 0;
  size_t dropped = 0;  ///< subjects left out because a rating of them is missing
  double single = 0.0, average = 0.0;
  std::optional<Interval> single_interval, average_interval;
  double subject_square = 0.0, rater_square = 0.0, error_square = 0.0;  ///< mean squares of the two-way table
};

/// Without an answer for fewer than two raters, fewer than two complete subjects, ratings that are all equal,
/// or means of subjects and raters that differ by less than error alone would make them (the denominator of
/// an ICC is then not over 0). Without intervals where raters differ by nothing but a constant. An interval
/// of one rater ends at -1 / (k - 1), the least that there is; one that reaches it leaves the mean of k
/// without.
Answer<IntraclassCorrelation> intraclass_correlation(const std::vector<RatingRow>& ratings,
                                                     double confidence = 0.95);

}  // namespace ream::statistics
