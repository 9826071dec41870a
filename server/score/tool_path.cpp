#include "score/tool_path.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace ream::score {
namespace {

constexpr double max_hz = 10.0, min_amplitude = 0.05;
constexpr int padding_octaves = 4;
constexpr size_t min_samples = 3;  // for a second difference

/// Greatest absolute speed; empty for what cannot be judged.
std::optional<double> peak_of(std::span<const double> speed, double rate_hz) {
  if (speed.size() < min_samples || !(rate_hz > 0.0)) return std::nullopt;
  double peak = 0.0;
  for (const double v : speed) {
    if (!std::isfinite(v)) return std::nullopt;
    peak = std::max(peak, std::abs(v));
  }
  return peak > 0.0 ? std::optional(peak) : std::nullopt;
}

/// Magnitudes of the spectrum up to half the rate, zero-padded, divided by the greatest.
std::vector<double> normalized_spectrum(std::span<const double> speed, double peak, size_t padded) {
  std::vector<double> samples(padded, 0.0);
  std::transform(speed.begin(), speed.end(), samples.begin(), [&](double v) { return v / peak; });
  std::vector<std::complex<double>> spectrum;
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  fft.fwd(spectrum, samples);
  std::vector<double> magnitudes(spectrum.size());
  std::transform(spectrum.begin(), spectrum.end(), magnitudes.begin(),
                 [](const std::complex<double>& z) { return std::abs(z); });
  const double greatest = *std::max_element(magnitudes.begin(), magnitudes.end());
  for (double& m : magnitudes) m /= greatest;
  return magnitudes;
}

}  // namespace

std::optional<double> spectral_arc_length(std::span<const double> speed, double rate_hz) {
  const auto peak = peak_of(speed, rate_hz);
  if (!peak) return std::nullopt;
  const double octaves = std::ceil(std::log2(static_cast<double>(speed.size())));
  const size_t padded = size_t{1} << (static_cast<int>(octaves) + padding_octaves);
  const std::vector<double> magnitude = normalized_spectrum(speed, *peak, padded);
  const double step_hz = rate_hz / static_cast<double>(padded);
  size_t first = magnitude.size(), last = 0;
  for (size_t k = 0; k < magnitude.size() && static_cast<double>(k) * step_hz <= max_hz; ++k) {
    if (magnitude[k] < min_amplitude) continue;
    first = std::min(first, k);
    last = k;
  }
  if (first >= last) return std::nullopt;
  const double step = 1.0 / static_cast<double>(last - first);
  double length = 0.0;
  for (size_t k = first; k < last; ++k) {
    const double rise = magnitude[k + 1] - magnitude[k];
    length += std::sqrt(step * step + rise * rise);
  }
  return -length;
}

std::optional<double> log_dimensionless_jerk(std::span<const double> speed, double rate_hz) {
  const auto peak = peak_of(speed, rate_hz);
  if (!peak) return std::nullopt;
  const double dt = 1.0 / rate_hz;
  double sum = 0.0;
  for (size_t i = 2; i < speed.size(); ++i) {
    const double jerk = (speed[i] - 2.0 * speed[i - 1] + speed[i - 2]) / (*peak * dt * dt);
    sum += jerk * jerk;
  }
  if (!(sum > 0.0)) return std::nullopt;
  const double duration_s = static_cast<double>(speed.size()) * dt;
  return -std::log(duration_s * duration_s * duration_s * sum * dt);
}

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
  if (slow_ == pause_samples || speed_.size() == max_samples) close();
}

void Strokes::close() {
  speed_.resize(speed_.size() - slow_);
  if (speed_.size() >= min_samples) {
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
    if (step_mm > max_step_mm)
      forget();
    else
      (engaged ? in_contact_mm_ : in_the_air_mm_) += step_mm;
  }
  before_mm_ = apex_mm;
  has_before_ = true;
  strokes_.add(apex_mm);
}

}  // namespace ream::score
