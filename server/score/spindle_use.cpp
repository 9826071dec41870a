#include "score/spindle_use.hpp"

#include <algorithm>
#include <cmath>

#include "core/clock.hpp"
#include "core/units.hpp"

namespace ream::score {

namespace {

constexpr int64_t parting_ticks = 500;  ///< off the bone; less parts no contacts

}  // namespace

/// Called while turning_ is still that of the tick before.
void SpindleUse::follow_start(const record::TickReport& r) {
  if (!r.engaged) {
    if (ticks_off_bone_ >= parting_ticks || r.spindle_on) standing_ticks_ = 0;
    return;
  }
  if (!r.spindle_on) {
    ++standing_ticks_;
    return;
  }
  if (turning_) return;
  ++starts_in_contact_;
  contact_before_spin_ticks_ += standing_ticks_;
  standing_ticks_ = 0;
}

void SpindleUse::add(const record::TickReport& r) {
  if (r.paused) return;
  follow_start(r);
  standing_press_ticks_ += r.engaged && !r.spindle_on && r.thrust_n >= pressing_n;
  air_spin_ticks_ += !r.engaged && r.spindle_on;
  withdrawn_spin_ticks_ += !r.engaged && r.spindle_on && touched_;
  restarts_ += r.spindle_on && !turning_ && turned_;
  turning_ = r.spindle_on;
  turned_ = turned_ || r.spindle_on;
  if (!r.engaged) {
    ++ticks_off_bone_;
    return;
  }
  if (touched_) idle_ticks_ += ticks_off_bone_;
  touched_ = true;
  ticks_off_bone_ = 0;
}

void SpindleUse::write(MetricResults& results) const {
  results.set_exact("standing_press_time_s", static_cast<double>(standing_press_ticks_) * tick_s);
  results.set_exact("air_spin_time_s", static_cast<double>(air_spin_ticks_) * tick_s);
  results.set_exact("idle_time_s", static_cast<double>(idle_ticks_) * tick_s);
  results.set("spindle_restarts", restarts_);
  results.set_exact("withdrawn_spin_time_s", static_cast<double>(withdrawn_spin_ticks_) * tick_s);
  results.set_exact("contact_before_spin_s", static_cast<double>(contact_before_spin_ticks_) * tick_s);
  results.set("spindle_starts_in_contact", starts_in_contact_);
}

void AxisSteadiness::add(const record::TickReport& r, const Pose& bone_from_tool) {
  if (!is_pressed_cut(r)) return;
  ++ticks_;
  sum_ += bone_from_tool.rotation.col(2);
}

void AxisSteadiness::write(MetricResults& results) const {
  if (ticks_ == 0) return results.set_missing("axis_sd_deg", never_cut);
  // The mean square of the distance of unit vectors from their mean direction.
  const double length = std::min(1.0, sum_.norm() / static_cast<double>(ticks_));
  results.set("axis_sd_deg", degrees_from_radians(std::sqrt(2.0 * (1.0 - length))));
}

}  // namespace ream::score
