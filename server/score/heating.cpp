#include "score/heating.hpp"

#include <algorithm>

#include "core/clock.hpp"

namespace ream::score {
namespace {

constexpr force::HeatSettings bone;

}  // namespace

void Heating::add(const record::TickReport& r) noexcept {
  if (r.surface_temperature_c == 0.0 || r.paused) return;
  peak_c_ = std::max(peak_c_, r.surface_temperature_c);
  over_47_ticks_ += r.surface_temperature_c >= force::dead_in_a_minute_c ? 1 : 0;
  over_56_ticks_ += r.surface_temperature_c >= force::dead_at_once_c ? 1 : 0;
  follow_profile(r);
}

void Heating::follow_profile(const record::TickReport& r) noexcept {
  // To the last bit only of bone that nothing has warmed: the reamer was set down elsewhere.
  if (r.surface_temperature_c == bone.body_c) {
    dead_elsewhere_mm_ = std::max(dead_elsewhere_mm_, column_.dead_depth_mm());
    column_ = {};
    ticks_ = 0;
    advance_mm_ = 0.0;
    return;
  }
  if (r.cutting) advance_mm_ += std::max(0.0, r.feed_rate_mm_s * tick_s);
  if (++ticks_ < force::HeatedBone::ticks_a_step) return;
  column_.step(bone, {0.0, force::holding_film_w_mm2_k, r.surface_temperature_c - bone.body_c}, advance_mm_,
               ticks_ * tick_s);
  ticks_ = 0;
  advance_mm_ = 0.0;
}

void Heating::write(MetricResults& results) const {
  if (peak_c_ == 0.0) {
    for (const char* key :
         {"surface_temperature_peak_c", "time_over_47_s", "time_over_56_s", "heated_bone_depth_mm"})
      results.set_missing(key, "heat was not simulated when this was recorded");
    return;
  }
  results.set("surface_temperature_peak_c", peak_c_);
  results.set_exact("time_over_47_s", static_cast<double>(over_47_ticks_) * tick_s);
  results.set_exact("time_over_56_s", static_cast<double>(over_56_ticks_) * tick_s);
  results.set("heated_bone_depth_mm", std::max(dead_elsewhere_mm_, column_.dead_depth_mm()));
}

}  // namespace ream::score
