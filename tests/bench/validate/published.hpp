#pragma once
#include <array>

namespace ream::bench {

/// One row of table 5.1: density, feed rate and apparent machining stiffness at 52 N.
struct Specimen {
  double density_g_cc, feed_mm_s, stiffness_n_mm;
};

/// Feed rate at the protocol's thrust: f = slope * D + intercept.
struct PublishedLaw {
  double slope_mm_s_per_g_cc, intercept_mm_s;
};

/// The protocol's thrust and spindle speed (thesis 5.1).
inline constexpr double published_thrust_n = 52.0, published_spindle_rpm = 156.0;

struct MeanAndDeviation {
  double mean = 0.0, deviation = 0.0;
};

/// What the thesis publishes about one kind of bone (chapter 5), typed in as it prints it: nothing here comes
/// from the product. Regression figures are those that its table gives, which the text rounds.
struct PublishedBone {
  const char* name;
  std::array<Specimen, 6> specimens;
  PublishedLaw law;
  double rho, r_squared, p;
  MeanAndDeviation thrust_n, feed_mm_s;  ///< at the protocol's full force, over the specimens
  int thrust_figure, density_figure;     ///< numbers of its pictures: 5.2 and 5.4, or 5.3 and 5.5
};

inline constexpr PublishedBone published_cortical{"cortical",
                                                  {{{1.52, 0.037, 58.24},
                                                    {1.54, 0.035, 83.28},
                                                    {1.61, 0.021, 84.34},
                                                    {1.40, 0.038, 81.06},
                                                    {1.58, 0.026, 53.66},
                                                    {1.30, 0.039, 83.10}}},
                                                  {-0.05, 0.11},
                                                  -0.7852,
                                                  0.617,
                                                  0.0642,
                                                  {53.17, 4.26},
                                                  {0.033, 0.007},
                                                  2,
                                                  4};

inline constexpr PublishedBone published_cancellous{"cancellous",
                                                    {{{0.55, 0.25, 44.06},
                                                      {0.41, 0.28, 40.70},
                                                      {0.72, 0.16, 50.42},
                                                      {0.45, 0.26, 48.42},
                                                      {0.62, 0.23, 27.28},
                                                      {0.48, 0.25, 39.45}}},
                                                    {-0.34, 0.42},
                                                    -0.9384,
                                                    0.881,
                                                    0.0056,
                                                    {51.87, 4.45},
                                                    {0.24, 0.04},
                                                    3,
                                                    5};

inline double law_mm_s(const PublishedBone& bone, double density_g_cc) {
  return bone.law.slope_mm_s_per_g_cc * density_g_cc + bone.law.intercept_mm_s;
}

/// The specimen's feed over the law's for its density: specimens of one density differ.
inline double specimen_factor(const PublishedBone& bone, const Specimen& specimen) {
  return specimen.feed_mm_s / law_mm_s(bone, specimen.density_g_cc);
}

}  // namespace ream::bench
