#include "statistics/distributions.hpp"

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

#include "core/error.hpp"

namespace ream::statistics {
namespace bm = boost::math;

double normal_quantile(double p) { return bm::quantile(bm::normal(), p); }
double two_sided_normal_p(double z) { return 2.0 * bm::cdf(bm::normal(), -std::abs(z)); }

double t_quantile(double p, double freedom) { return bm::quantile(bm::students_t(freedom), p); }
double two_sided_t_p(double t, double freedom) {
  return std::isinf(t) ? 0.0 : 2.0 * bm::cdf(bm::students_t(freedom), -std::abs(t));
}

double noncentral_t_cdf(double t, double freedom, double shift) {
  return bm::cdf(bm::non_central_t(freedom, shift), t);
}

double noncentrality_of_t(double t, double freedom, double p) {
  double step = 1.0;
  while (noncentral_t_cdf(t, freedom, t - step) < p) step *= 2.0;
  double low = t - step;
  step = 1.0;
  while (noncentral_t_cdf(t, freedom, t + step) > p) step *= 2.0;
  double high = t + step;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (noncentral_t_cdf(t, freedom, middle) > p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double f_quantile(double p, double freedom_above, double freedom_below) {
  return bm::quantile(bm::fisher_f(freedom_above, freedom_below), p);
}
double beta_quantile(double p, double a, double b) { return bm::quantile(bm::beta_distribution<>(a, b), p); }

double binomial_density(size_t successes, size_t trials, double p) {
  return bm::pdf(bm::binomial(static_cast<double>(trials), p), static_cast<double>(successes));
}
double binomial_cdf(size_t successes, size_t trials, double p) {
  return bm::cdf(bm::binomial(static_cast<double>(trials), p), static_cast<double>(successes));
}

double gamma_ratio(double x, double delta) { return bm::tgamma_delta_ratio(x, delta); }

double tail_of(double confidence) {
  if (!(confidence > 0.0 && confidence < 1.0))
    throw Error(ErrorKind::invalid_input, "a confidence must lie between 0 and 1 (0.95)");
  return 0.5 * (1.0 - confidence);
}

}  // namespace ream::statistics
