#include "device/simulated/hand_model.hpp"

#include <algorithm>

#include "core/clock.hpp"
#include "core/hash.hpp"
#include "core/units.hpp"

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

size_t ticks_of(double time_s, size_t max_ticks) {
  return std::clamp(static_cast<size_t>(time_s / tick_s + 0.5), size_t{1}, max_ticks);
}

/// Of a wrist that the script calls rigid: an admittance device turns where it is told, so it must give.
/// Stiff enough that 1 N m turns it by one degree. Engineering choice.
constexpr Wrist firm_wrist{5.0e4, 500.0, 1.0e4};

HandParameters without_wrist(HandParameters hand) {
  hand.wrist.reset();
  return hand;
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

HandModel::HandModel(const HandParameters& hand, uint64_t random_seed)
    : hand_(hand),
      tremor_(random_seed, hand.tremor_rms_n),
      held_(rotation_from_small_vector(hand.tilt_rad)),
      position_mm_(hand.start_mm),
      reaction_ticks_(ticks_of(hand.reaction_time_s, max_reaction_ticks)) {}

void HandModel::begin() noexcept {
  tremor_.begin();
  position_mm_ = hand_.start_mm;
  felt_n_.fill(0.0);
  turn_rad_.setZero();
  rest();
}

void HandModel::hold(const Vec3& on_line_mm, const Mat3& held) noexcept {
  hand_.start_mm = on_line_mm;
  held_ = held;
}

void HandModel::rest() noexcept {
  velocity_mm_s_.setZero();
  turn_rate_rad_s_.setZero();
}

Pose HandModel::plan_from_hand() const noexcept {
  if (!hand_.wrist) return {held_, position_mm_};
  return {held_ * rotation_from_small_vector(turn_rad_), position_mm_};
}

double HandModel::push_n(double target_n, double felt_n) noexcept {
  // The ring's oldest entry is overwritten by the newest after it has been used.
  double& entry = felt_n_[now_];
  const double felt_then_n = entry;
  entry = felt_n;
  now_ = now_ + 1 < reaction_ticks_ ? now_ + 1 : 0;
  // A hand in the air has nothing to correct.
  const bool corrects = target_n > 0.0 && felt_then_n > 0.0;
  return corrects ? target_n + hand_.correction_gain * (target_n - felt_then_n) : target_n;
}

void HandModel::turn(const Vec3& torque_n_mm) noexcept {
  const Wrist& wrist = *hand_.wrist;
  const double gain = tick_s * rad_s2_per_n_mm_kg_mm2 / wrist.inertia_kg_mm2;
  // Spring and damper implicitly: stable however light the hand and stiff the wrist.
  const double held_back = gain * (wrist.damping_n_mm_s_rad + tick_s * wrist.stiffness_n_mm_rad);
  const Vec3 drive = held_.transpose() * torque_n_mm - wrist.stiffness_n_mm_rad * turn_rad_;
  turn_rate_rad_s_ = (turn_rate_rad_s_ + gain * drive) / (1.0 + held_back);
  turn_rad_ += tick_s * turn_rate_rad_s_;
}

void HandModel::advance(double target_n, const Load& felt) noexcept {
  const Vec3 axis = held_.col(2);
  const Vec3 off_line = position_mm_ - hand_.start_mm;
  const double along_mm = axis.dot(off_line);
  const Vec3 sideways = off_line - axis * along_mm;
  const double pushed_n = push_n(target_n, -axis.dot(felt.force_n));
  const Vec3 force_n = axis * pushed_n - hand_.guide_stiffness_n_mm * sideways + felt.force_n -
                       hand_.arm_stiffness_n_mm * along_mm * axis + tremor_.next();
  // Damping is taken implicitly so that a light hand stays stable.
  const double gain = tick_s * mm_s2_per_n_kg / hand_.mass_kg;
  velocity_mm_s_ = (velocity_mm_s_ + gain * force_n) / (1.0 + gain * hand_.arm_damping_n_s_mm);
  position_mm_ += tick_s * velocity_mm_s_;
  if (hand_.wrist) turn(felt.torque_n_mm);
}

GrippingHand::GrippingHand(const HandParameters& hand, uint64_t random_seed)
    : HandModel(without_wrist(hand), random_seed),
      stiffness_n_mm_(hand.grip_stiffness_n_mm),
      damping_n_s_mm_(hand.grip_damping_n_s_mm),
      wrist_(hand.wrist.value_or(firm_wrist)) {}

Load GrippingHand::grip(const Pose& plan_from_handle, const Vec3& velocity_of_handle_mm_s,
                        const Vec3& turn_rate_of_handle_rad_s) const noexcept {
  const Vec3 stretch_mm = plan_from_hand().translation_mm - plan_from_handle.translation_mm;
  const Vec3 slip_mm_s = velocity_mm_s() - velocity_of_handle_mm_s;
  const Mat3& held = held_rotation();
  return {stiffness_n_mm_ * stretch_mm + damping_n_s_mm_ * slip_mm_s,
          held * (-wrist_.stiffness_n_mm_rad * turn_between(held, plan_from_handle.rotation) -
                  wrist_.damping_n_mm_s_rad * turn_rate_of_handle_rad_s)};
}

}  // namespace ream::device
