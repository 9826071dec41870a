#include "score/handling.hpp"

#include <algorithm>
#include <cmath>

#include "core/clock.hpp"
#include "force/edge_load.hpp"
#include "voxel/bone_model.hpp"

namespace ream::score {
namespace {

bool presses(const record::TickReport& r) { return r.engaged && r.spindle_on && r.thrust_n >= pressing_n; }

double share_of(const record::TickReport& r, voxel::BoneClass bone_class) {
  return r.share[static_cast<size_t>(bone_class)];
}

/// Cartilage has one feed, whatever its density.
bool is_extrapolated(const record::TickReport& r) {
  return r.cutting && share_of(r, voxel::BoneClass::cartilage) < reached_share &&
         !force::is_fitted_density(r.density_g_cc);
}

}  // namespace

void AdvanceUntilRelease::begin(double axial_mm) {
  begun_ = true;
  from_mm_ = deepest_mm_ = axial_mm;
}

void AdvanceUntilRelease::add(const record::TickReport& r, double axial_mm) {
  if (!begun_ || advance_) return;
  ++ticks_;
  if (r.engaged) deepest_mm_ = std::max(deepest_mm_, axial_mm);
  if (!r.engaged || r.thrust_n < pressing_n)
    advance_ = Advance{deepest_mm_ - from_mm_, static_cast<double>(ticks_) * tick_s};
}

void Breakthrough::add(const record::TickReport& r, double axial_mm) {
  if (inside_.begun())
    inside_.add(r, axial_mm);
  else if (presses(r) && share_of(r, voxel::BoneClass::cancellous) >= reached_share)
    inside_.begin(axial_mm);
}

void PlateStop::add(const record::TickReport& r, double axial_mm) {
  if (beyond_.begun()) return beyond_.add(r, axial_mm);
  if (!presses(r)) return;
  cartilage_ = cartilage_ || share_of(r, voxel::BoneClass::cartilage) >= reached_share;
  const double bone = share_of(r, voxel::BoneClass::cancellous) + share_of(r, voxel::BoneClass::cortical);
  if (cartilage_ && bone >= reached_share) beyond_.begin(axial_mm);
}

void ContactPasses::add(const record::TickReport& report) {
  if (!report.engaged || report.thrust_n <= pressing_n) {
    ++ticks_since_;
    return;
  }
  if (ticks_since_ > gap_ticks) ++count_;
  ticks_since_ = 0;
}

void Thrust::add(const record::TickReport& r, double axial_mm) {
  if (is_pressed_cut(r)) {
    ++cutting_ticks_;
    sum_n_ += r.thrust_n;
    sum_n2_ += r.thrust_n * r.thrust_n;
  }
  if (r.engaged && r.spindle_on) {
    overload_ticks_ += r.thrust_n > excess_from_n;
    peak_n_ = std::max(peak_n_, r.thrust_n);
    excess_n_s_ += std::max(0.0, r.thrust_n - excess_from_n) * tick_s;
  }
  follow_rise(r, axial_mm);
}

void Thrust::follow_rise(const record::TickReport& r, double axial_mm) {
  if (risen_) return;
  const bool pressed = r.engaged && r.spindle_on && r.thrust_n >= stiffness_from_n;
  if (pressed && !rising_) {
    rise_thrust_n_ = r.thrust_n;
    rise_mm_ = axial_mm;
  }
  rising_ = pressed;
  if (!pressed || r.thrust_n < stiffness_to_n) return;
  risen_ = true;
  if (axial_mm > rise_mm_) apparent_stiffness_n_mm_ = (r.thrust_n - rise_thrust_n_) / (axial_mm - rise_mm_);
}

void Thrust::write(MetricResults& results) const {
  std::optional<double> mean_n, sd_n;
  if (cutting_ticks_ > 0) {
    const auto ticks = static_cast<double>(cutting_ticks_);
    mean_n = sum_n_ / ticks;
    sd_n = std::sqrt(std::max(0.0, sum_n2_ / ticks - *mean_n * *mean_n));
  }
  results.set_or_missing("axial_thrust_mean_n", mean_n, never_cut);
  results.set_or_missing("axial_thrust_sd_n", sd_n, never_cut);
  results.set_exact("overload_time_s", static_cast<double>(overload_ticks_) * tick_s);
  results.set_exact("axial_thrust_peak_n", peak_n_);
  results.set("axial_thrust_excess_n_s", excess_n_s_);
  if (apparent_stiffness_n_mm_)
    results.set_exact("apparent_stiffness_n_mm", *apparent_stiffness_n_mm_);
  else
    results.set_missing("apparent_stiffness_n_mm", "thrust has not risen from 1 N to 90 % of 52 N in one go");
}

void Handling::add(const record::TickReport& r, const Vec3& in_bone_mm, double axial_mm) {
  ++ticks_;
  contact_ticks_ += r.engaged ? 1 : 0;
  weakened_ticks_ += r.weakened ? 1 : 0;
  extrapolated_ticks_ += is_extrapolated(r) ? 1 : 0;
  stalls_ += r.stalled && !stalled_ ? 1 : 0;
  if (!r.paused) stalled_ = r.stalled;
  thrust_.add(r, axial_mm);
  breakthrough_.add(r, axial_mm);
  plate_stop_.add(r, axial_mm);
  passes_.add(r);
  spindle_use_.add(r);
  path_.add(in_bone_mm, r.engaged, r.paused);
  economy_.add(r, in_bone_mm, axial_mm);
  contact_spread_.add(r, in_bone_mm);
  thrust_rate_.add(r);
}

double Handling::duration_s() const { return static_cast<double>(ticks_) * tick_s; }

void Handling::write(MetricResults& results) const {
  results.set_exact("duration_s", duration_s());
  results.set_exact("contact_time_s", static_cast<double>(contact_ticks_) * tick_s);
  results.set_exact("weakened_time_s", static_cast<double>(weakened_ticks_) * tick_s);
  results.set("spindle_stalls", stalls_);
  results.set_exact("extrapolated_time_s", static_cast<double>(extrapolated_ticks_) * tick_s);
  thrust_.write(results);
  thrust_rate_.write(results);
  write_advances(results);
  spindle_use_.write(results);
  results.set("passes", passes_.count());
  results.set("path_in_contact_mm", path_.in_contact_mm());
  results.set("path_out_of_contact_mm", path_.in_the_air_mm());
  economy_.write(results);
  contact_spread_.write(results);
  const Strokes& strokes = path_.strokes();
  results.set("strokes", strokes.count());
  const char* no_stroke = "the tool made no stroke";
  results.set_or_missing("sparc", strokes.mean_sparc(), no_stroke);
  results.set_or_missing("ldlj", strokes.mean_ldlj(), no_stroke);
}

void Handling::write_advances(MetricResults& results) const {
  const AdvanceUntilRelease& inside = breakthrough_.inside();
  if (inside.advance()) {
    results.set("breakthrough_advance_mm", inside.advance()->mm);
    results.set("breakthrough_time_s", inside.advance()->s);
  } else {
    for (const char* key : {"breakthrough_advance_mm", "breakthrough_time_s"})
      results.set_missing(key, inside.begun()
                                   ? "thrust has not fallen below 5 N since cancellous bone was reached"
                                   : "no cancellous bone was pressed on");
  }
  const AdvanceUntilRelease& beyond = plate_stop_.beyond();
  if (beyond.advance())
    results.set("plate_overrun_mm", beyond.advance()->mm);
  else
    results.set_missing("plate_overrun_mm",
                        !plate_stop_.touched_cartilage() ? "no cartilage was reamed"
                        : beyond.begun() ? "thrust has not fallen below 5 N since the plate was reached"
                                         : "the plate under the cartilage was not reached");
}

}  // namespace ream::score
