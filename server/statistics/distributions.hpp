#pragma once
#include <cstddef>

namespace ream::statistics {

/// Distributions of Boost.Math. Degrees of freedom may be fractions; they are over 0. Probabilities that go
/// into a quantile lie between 0 and 1, both excluded.

double normal_quantile(double p);
/// Chance of a normal deviate farther from 0 than `z` is.
double two_sided_normal_p(double z);

double t_quantile(double p, double freedom);
/// Chance that Student's t is farther from 0 than `t`; 0 for an infinite one.
double two_sided_t_p(double t, double freedom);

/// Chance that t with non-centrality `shift` is at most `t`.
double noncentral_t_cdf(double t, double freedom, double shift);
/// The non-centrality at which `t` is reached from below with chance `p`. Bisection on noncentral_t_cdf,
/// which falls as the non-centrality grows.
double noncentrality_of_t(double t, double freedom, double p);

double f_quantile(double p, double freedom_above, double freedom_below);
double beta_quantile(double p, double a, double b);

/// Chance of exactly, or of at most, `successes` of `trials` with chance `p` each.
double binomial_density(size_t successes, size_t trials, double p);
double binomial_cdf(size_t successes, size_t trials, double p);

/// Gamma(x) / Gamma(x + delta)
double gamma_ratio(double x, double delta);

/// Half of what a confidence leaves out: 0.025 of 0.95. Error invalid_input unless it lies between 0 and 1.
double tail_of(double confidence);

}  // namespace ream::statistics
