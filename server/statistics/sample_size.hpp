#pragma once
#include <cstddef>

namespace ream::statistics {

/// What a study that is planned shall be able to show. Chances lie between 0 and 1.
struct TestAim {
  double significance = 0.05;  ///< two-sided, unless said otherwise
  double power = 0.80;         ///< chance to find an effect that is there
};

/// Chance that Student's test of two groups of `per_group` finds means that are `effect` standard deviations
/// apart: both tails of the non-central t (Cohen 1988, Statistical Power Analysis, chapter 2).
double power_of_two_means(double effect, size_t per_group, double significance = 0.05);

/// Persons in each of two groups for that. Error invalid_input for an effect of 0, or one that needs more
/// than a million.
size_t size_for_two_means(double effect, const TestAim& aim = {});

/// Persons in each of two groups to tell two shares apart, by the normal distribution without correction for
/// continuity (Fleiss, Statistical Methods for Rates and Proportions, section 3.2). Error invalid_input
/// unless they differ and lie between 0 and 1.
size_t size_for_two_shares(double first, double second, const TestAim& aim = {});

/// Subjects for `raters` raters to show that the ICC is over `least` when it is `expected`; the significance
/// is one-sided (Walter, Eliasziw & Donner 1998, "Sample size and optimal designs for reliability studies",
/// Stat Med 17, formula 5). Error invalid_input unless 0 <= least < expected < 1 and raters >= 2.
size_t size_for_agreement_over(double least, double expected, size_t raters, const TestAim& aim = {});

/// Subjects for `raters` raters so that the interval of an ICC of `expected` is about `width` wide (Bonett
/// 2002, "Sample size requirements for estimating intraclass correlations with desired precision", Stat Med
/// 21, formula 3 with its correction for two raters from 0.7). Error invalid_input unless 0 < expected < 1,
/// 0 < width < 2 and raters >= 2.
size_t size_for_agreement_width(double expected, double width, size_t raters, double confidence = 0.95);

}  // namespace ream::statistics
