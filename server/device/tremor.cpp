#include "device/tremor.hpp"

#include "core/hash.hpp"

namespace ream::device {
namespace {

/// Butterworth band-pass of order 2 x 2 for 8 to 12 Hz at 1 kHz, bilinear with prewarped edges. As numbers,
/// so that they are the same whatever mathematical library is linked; the tests hold the response to its
/// edges.
constexpr double a1[2] = {-1.9820930132591448, -1.97485703372735};
constexpr double a2[2] = {0.9849050572624547, 0.9798722900068966};
constexpr double b0 = 0.012455859001919398;  ///< of each section: (b0, 0, -b0)

/// Long enough for the filter's memory to fade: its slower pole loses 0.76 % a tick.
constexpr int run_in_ticks = 2000;

/// Even in -1..1, 53 bits, from a counter.
double noise(uint64_t seed, uint64_t counter) {
  const uint64_t word = hash_combine(seed, counter);
  return static_cast<double>(word >> 11) * 0x1p-52 - 1.0;
}

}  // namespace

double Tremor::Section::run(double x, double p1, double p2) noexcept {
  const double y = b0 * x + s1;
  s1 = s2 - p1 * y;
  s2 = -b0 * x - p2 * y;
  return y;
}

double Tremor::filtered(std::array<Section, 2>& sections, double x) noexcept {
  return sections[1].run(sections[0].run(x, a1[0], a2[0]), a1[1], a2[1]);
}

Tremor::Tremor(uint64_t seed, double rms_n) : seed_(hash_text("tremor", seed)) {
  // White noise of variance 1/3 comes out with that times the energy of the impulse response.
  double energy = 0.0;
  std::array<Section, 2> sections;
  for (int i = 0; i < run_in_ticks; ++i) {
    const double h = filtered(sections, i == 0 ? 1.0 : 0.0);
    energy += h * h;
  }
  gain_ = rms_n / std::sqrt(energy / 3.0);
}

void Tremor::begin() noexcept {
  counter_ = 0;
  sections_ = {};
  for (int i = 0; i < run_in_ticks; ++i) next();
}

Vec3 Tremor::next() noexcept {
  if (gain_ == 0.0) return Vec3::Zero();
  Vec3 force_n;
  for (size_t k = 0; k < 3; ++k)
    force_n[static_cast<Eigen::Index>(k)] = gain_ * filtered(sections_[k], noise(seed_, counter_++));
  return force_n;
}

}  // namespace ream::device
