#include "score/tool_path.hpp"

#include "score/smoothness.hpp"

namespace ream::score {

void Strokes::add(const Vec3& position_mm) {
  sum_mm_ += position_mm;
  if (++ticks_ < ticks_a_sample) return;
  const Vec3 mean_mm = sum_mm_ / ticks_a_sample;
  sum_mm_.setZero();
  ticks_ = 0;
  if (has_before_) take_speed((mean_mm - before_mm_).norm() * rate_hz);
  before_mm_ = mean_mm;
  has_before_ = true;
}

void Strokes::interrupt() {
  close();
  sum_mm_.setZero();
  ticks_ = 0;
  has_before_ = false;
}

void Strokes::take_speed(double speed_mm_s) {
  const bool moves = speed_mm_s > still_mm_s;
  if (!moves && speed_.empty()) return;
  speed_.push_back(speed_mm_s);
  slow_ = moves ? 0 : slow_ + 1;
  if (slow_ == pause_samples || speed_.size() == most_samples) close();
}

void Strokes::close() {
  speed_.resize(speed_.size() - slow_);
  if (speed_.size() >= least_samples) {
    ++count_;
    if (const auto sparc = spectral_arc_length(speed_, rate_hz)) sparc_sum_ += *sparc, ++sparc_count_;
    if (const auto ldlj = log_dimensionless_jerk(speed_, rate_hz)) ldlj_sum_ += *ldlj, ++ldlj_count_;
  }
  speed_.clear();
  slow_ = 0;
}

std::optional<double> Strokes::mean_sparc() const {
  return sparc_count_ > 0 ? std::optional(sparc_sum_ / sparc_count_) : std::nullopt;
}

std::optional<double> Strokes::mean_ldlj() const {
  return ldlj_count_ > 0 ? std::optional(ldlj_sum_ / ldlj_count_) : std::nullopt;
}

void ToolPath::forget() {
  has_before_ = false;
  strokes_.interrupt();
}

void ToolPath::add(const Vec3& apex_mm, bool engaged, bool paused) {
  if (paused) return forget();
  if (has_before_) {
    const double step_mm = (apex_mm - before_mm_).norm();
    if (step_mm > longest_step_mm)
      forget();
    else
      (engaged ? in_contact_mm_ : in_the_air_mm_) += step_mm;
  }
  before_mm_ = apex_mm;
  has_before_ = true;
  strokes_.add(apex_mm);
}

}  // namespace ream::score
