#pragma once
#include <optional>
#include <span>
#include <vector>

#include "geometry/vec.hpp"

namespace ream::score {

/// Parts the way of a point into strokes and tells how smooth they are. A stroke is a movement at over 1 mm/s
/// from when it begins until the speed has been below that for 0.1 s (which no longer belong to it); it
/// counts when it takes at least 0.2 s. Speed is that of the means of ten ticks, 100 times a second, so that
/// the feed of a cutting tool (below 0.5 mm/s) is no stroke, and a tremor not many. Limits are engineering
/// judgement.
class Strokes {
 public:
  static constexpr double rate_hz = 100.0;
  static constexpr double still_mm_s = 1.0;
  static constexpr size_t min_samples = 20, pause_samples = 10;
  static constexpr size_t max_samples = 3000;  ///< one that takes longer than half a minute is parted

  /// Once a tick.
  void add(const Vec3& position_mm);
  /// What comes has nothing to do with what was: a pause, or another place.
  void interrupt();

  /// Strokes that have ended.
  int count() const { return count_; }
  /// Means over them; empty without any.
  std::optional<double> mean_sparc() const;
  std::optional<double> mean_ldlj() const;

 private:
  static constexpr int ticks_a_sample = 10;

  void take_speed(double speed_mm_s);
  void close();

  Vec3 sum_mm_ = Vec3::Zero(), before_mm_ = Vec3::Zero();
  int ticks_ = 0;              ///< in sum_mm_
  bool has_before_ = false;    ///< before_mm_ is the mean of the ten ticks before
  std::vector<double> speed_;  ///< of the stroke that goes on, mm/s
  size_t slow_ = 0;            ///< its last samples that are below still_mm_s
  int count_ = 0, sparc_count_ = 0, ldlj_count_ = 0;
  double sparc_sum_ = 0.0, ldlj_sum_ = 0.0;
};

/// The way of the tool's apex in the bone's frame: its length in contact and in the air, and its strokes.
/// While a session is paused nothing is added; a step of more than 1 mm in one tick is no movement but a
/// session that goes on elsewhere.
class ToolPath {
 public:
  static constexpr double max_step_mm = 1.0;

  /// Once a tick.
  void add(const Vec3& apex_mm, bool engaged, bool paused);
  double in_contact_mm() const { return in_contact_mm_; }
  double in_the_air_mm() const { return in_the_air_mm_; }
  const Strokes& strokes() const { return strokes_; }

 private:
  void forget();

  bool has_before_ = false;
  Vec3 before_mm_ = Vec3::Zero();
  double in_contact_mm_ = 0.0, in_the_air_mm_ = 0.0;
  Strokes strokes_;
};

// Smoothness of one movement by its speed, sampled evenly at `rate_hz`. Both are without unit and more
// negative for less smooth movements (Balasubramanian et al. 2015, as their program computes them). Empty for
// speeds that are all zero, not finite, or too few.

/// SPARC: length of the arc of the speed's normalized spectrum, to 10 Hz or where it last reaches 5 % of its
/// peak. Zero-padded to 2^(ceil(log2 N) + 4) samples.
std::optional<double> spectral_arc_length(std::span<const double> speed, double rate_hz);

/// LDLJ: -ln of T^3 / peak^2 times the integral of the second derivative of speed squared.
std::optional<double> log_dimensionless_jerk(std::span<const double> speed, double rate_hz);

}  // namespace ream::score
