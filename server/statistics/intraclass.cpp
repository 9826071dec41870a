#include "statistics/intraclass.hpp"

#include <utility>

#include "core/error.hpp"
#include "statistics/distributions.hpp"

namespace ream::statistics {
namespace {

double square_of(double value) { return value * value; }

void fill_mean_squares(const std::vector<std::vector<double>>& rows, IntraclassCorrelation& result) {
  const size_t raters = rows.front().size();
  const double n = static_cast<double>(rows.size()), k = static_cast<double>(raters);
  std::vector<double> of_rater(raters, 0.0), of_subject(rows.size(), 0.0);
  double grand = 0.0;
  for (size_t i = 0; i < rows.size(); ++i)
    for (size_t j = 0; j < raters; ++j) {
      of_subject[i] += rows[i][j] / k;
      of_rater[j] += rows[i][j] / n;
      grand += rows[i][j] / (n * k);
    }
  double error = 0.0, subjects = 0.0, judges = 0.0;
  for (size_t i = 0; i < rows.size(); ++i)
    for (size_t j = 0; j < raters; ++j) error += square_of(rows[i][j] - of_subject[i] - of_rater[j] + grand);
  for (const double mean : of_subject) subjects += k * square_of(mean - grand);
  for (const double mean : of_rater) judges += n * square_of(mean - grand);
  result.subject_square = subjects / (n - 1.0);
  result.rater_square = judges / (k - 1.0);
  result.error_square = error / ((n - 1.0) * (k - 1.0));
}

/// Satterthwaite's degrees of freedom of Shrout & Fleiss, and the bounds that follow from them.
Interval interval_of_single(const IntraclassCorrelation& icc, double tail) {
  const double n = static_cast<double>(icc.subjects), k = static_cast<double>(icc.raters);
  const double bms = icc.subject_square, jms = icc.rater_square, ems = icc.error_square;
  const double rho = icc.single, fj = jms / ems;
  const double rest = n * (1.0 + (k - 1.0) * rho) - k * rho;
  const double freedom = (k - 1.0) * (n - 1.0) * square_of(k * rho * fj + rest) /
                         ((n - 1.0) * square_of(k * rho * fj) + square_of(rest));
  const double f_low = f_quantile(1.0 - tail, n - 1.0, freedom);
  const double f_high = f_quantile(1.0 - tail, freedom, n - 1.0);
  const double others = k * jms + (k * n - k - n) * ems;
  return {n * (bms - f_low * ems) / (f_low * others + n * bms),
          n * (f_high * bms - ems) / (others + n * f_high * bms)};
}

/// Of the mean of k raters, from that of one (Spearman-Brown).
double stepped_up(double single, double k) { return k * single / (1.0 + (k - 1.0) * single); }

bool ratings_differ(const std::vector<std::vector<double>>& rows) {
  for (const auto& row : rows)
    for (const double value : row)
      if (value != rows.front().front()) return true;
  return false;
}

/// Adds what intervals there are, and says why there is not more. An ICC of one rater is over -1 / (k - 1);
/// at that value the one of the mean of k raters has its pole.
std::string add_agreement_intervals(IntraclassCorrelation& icc, double tail) {
  const double k = static_cast<double>(icc.raters), least = -1.0 / (k - 1.0);
  Interval single = interval_of_single(icc, tail);
  if (!(single.high > least)) return "the ratings are too few for an interval of agreement";
  if (single.low > least) {
    icc.single_interval = single;
    icc.average_interval = Interval{stepped_up(single.low, k), stepped_up(single.high, k)};
    return "";
  }
  single.low = least;
  icc.single_interval = single;
  return "the interval of one rater's agreement goes down to its lowest possible value, so that the "
         "agreement of the mean of all raters has no interval";
}

}  // namespace

CompleteRatings complete_rows(const std::vector<RatingRow>& ratings) {
  CompleteRatings complete;
  for (const RatingRow& row : ratings) {
    if (row.size() != ratings.front().size())
      throw Error(ErrorKind::invalid_input, "a table of ratings needs as many raters in every row");
    std::vector<double> values;
    for (const std::optional<double>& value : row)
      if (value) values.push_back(*value);
    if (values.size() == row.size())
      complete.rows.push_back(std::move(values));
    else
      ++complete.dropped;
  }
  return complete;
}

Answer<IntraclassCorrelation> intraclass_correlation(const std::vector<RatingRow>& ratings,
                                                     double confidence) {
  const double tail = tail_of(confidence);
  const CompleteRatings complete = complete_rows(ratings);
  if (ratings.empty() || ratings.front().size() < 2)
    return {std::nullopt, "agreement needs two raters or more"};
  if (complete.rows.size() < 2)
    return {std::nullopt, "agreement needs two subjects or more that all raters have rated"};
  IntraclassCorrelation icc;
  icc.subjects = complete.rows.size();
  icc.raters = complete.rows.front().size();
  icc.dropped = complete.dropped;
  if (!ratings_differ(complete.rows))
    return {std::nullopt,
            "the ratings do not differ between subjects or raters, so that agreement has no measure"};
  fill_mean_squares(complete.rows, icc);
  const double n = static_cast<double>(icc.subjects), k = static_cast<double>(icc.raters);
  const double of_raters = (icc.rater_square - icc.error_square) / n;
  const double all_of_one = icc.subject_square + (k - 1.0) * icc.error_square + k * of_raters;
  const double rounding = 1e-12 * (icc.subject_square + icc.rater_square);
  if (all_of_one <= rounding || icc.subject_square + of_raters <= rounding)
    return {std::nullopt,
            "the means of subjects and of raters differ by less than chance alone would make them, so that "
            "agreement has no measure"};
  icc.single = (icc.subject_square - icc.error_square) / all_of_one;
  icc.average = (icc.subject_square - icc.error_square) / (icc.subject_square + of_raters);
  if (icc.error_square <= rounding)
    return {icc, "raters differ by nothing but a constant, which has no interval"};
  std::string note = add_agreement_intervals(icc, tail);
  return {icc, std::move(note)};
}

}  // namespace ream::statistics
