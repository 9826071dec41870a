#include "force/heat.hpp"

#include <algorithm>

#include "core/clock.hpp"
#include "core/units.hpp"

namespace ream::force {
namespace {

struct Cells {
  /// Width; distance of a cell's middle from the next one's.
  std::array<double, HeatColumn::cells> width_mm{}, to_next_mm{};

  constexpr Cells() {
    double width = 0.04;
    for (double& w : width_mm) {
      w = width;
      width *= 1.09;
    }
    for (size_t i = 0; i + 1 < width_mm.size(); ++i) to_next_mm[i] = 0.5 * (width_mm[i] + width_mm[i + 1]);
  }
};
constexpr Cells grid;

}  // namespace

double HeatColumn::width_mm(size_t cell) noexcept { return grid.width_mm[cell]; }

void HeatColumn::solve(const HeatSettings& bone, const HeatSurface& surface, double advance_mm,
                       double dt_s) noexcept {
  const double conductivity = bone.conductivity_w_m_k * 1e-3;  // W/(mm K)
  const double capacity = bone.heat_capacity_mj_m3_k * 1e-3;   // J/(mm3 K)
  // What passes into the first cell is `given - taken * its temperature`.
  const double half_cell = 0.5 * grid.width_mm[0] / conductivity;
  const double taken = surface.film_w_mm2_k / (1.0 + surface.film_w_mm2_k * half_cell);
  const double given = (surface.flux_w_mm2 + surface.film_w_mm2_k * surface.around_k) /
                       (1.0 + surface.film_w_mm2_k * half_cell);
  const double carried = capacity * advance_mm / dt_s;  // W/(mm2 K), towards the surface
  // Elimination from the surface down, with bone of the body's temperature below the last cell.
  std::array<double, cells> next;
  double from_above = 0.0, above_next = 0.0, above_value = 0.0;
  for (size_t i = 0; i < cells; ++i) {
    const double stored = capacity * grid.width_mm[i] / dt_s;
    const double to_below = i + 1 < cells ? conductivity / grid.to_next_mm[i] : 0.0;
    const double diagonal = stored + carried + from_above + to_below + (i == 0 ? taken : 0.0);
    const double value = stored * excess_k_[i] + (i == 0 ? given : 0.0);
    const double scale = 1.0 / (diagonal - from_above * above_next);
    next[i] = (to_below + carried) * scale;
    excess_k_[i] = (value + from_above * above_value) * scale;
    from_above = to_below;
    above_next = next[i];
    above_value = excess_k_[i];
  }
  for (size_t i = cells - 1; i-- > 0;) excess_k_[i] += next[i] * excess_k_[i + 1];
  surface_k_ = excess_k_[0] + half_cell * (given - taken * excess_k_[0]);
}

double HeatColumn::depth_over_mm(double excess_k) const noexcept {
  double depth_mm = 0.0, middle_mm = 0.5 * grid.width_mm[0], above_mm = 0.0, above_k = surface_k_;
  for (size_t i = 0; i < cells; ++i) {
    const double here_k = excess_k_[i];
    if (here_k >= excess_k)
      depth_mm = middle_mm;
    else if (above_k >= excess_k)
      depth_mm = above_mm + (middle_mm - above_mm) * (above_k - excess_k) / (above_k - here_k);
    above_mm = middle_mm;
    above_k = here_k;
    middle_mm += grid.to_next_mm[i];
  }
  return depth_mm;
}

void HeatColumn::step(const HeatSettings& bone, const HeatSurface& surface, double advance_mm,
                      double dt_s) noexcept {
  solve(bone, surface, advance_mm, dt_s);
  dead_depth_mm_ = std::max({0.0, dead_depth_mm_ - advance_mm, depth_over_mm(dead_at_once_c - bone.body_c)});
}

bool HeatedBone::elsewhere(const HeatTick& tick) const noexcept {
  const Vec3 way_mm = tick.apex_mm - place_mm_;
  const double along_mm = way_mm.dot(tick.axis);
  return (way_mm.squaredNorm() - along_mm * along_mm) * pi > largest_area_mm2_;
}

void HeatedBone::add(const HeatSettings& bone, const HeatTick& tick) noexcept {
  const bool works = tick.power_w > 0.0 && tick.area_mm2 > 0.0;
  if (works && placed_ && elsewhere(tick)) *this = {};
  if (works && !placed_) {
    placed_ = true;
    place_mm_ = tick.apex_mm;
    largest_area_mm2_ = bone.least_area_mm2;
  }
  if (!placed_) return;
  if (works) {
    largest_area_mm2_ = std::max(largest_area_mm2_, tick.area_mm2);
    energy_j_ += tick.power_w * tick_s;
    area_mm2_ += tick.area_mm2;
    ++working_ticks_;
  }
  advance_mm_ += std::max(0.0, tick.advance_mm);
  irrigated_ = irrigated_ || tick.irrigated;
  if (++ticks_ < ticks_a_step) return;
  const double dt_s = ticks_ * tick_s;
  HeatSurface surface;
  if (working_ticks_ > 0)
    surface.flux_w_mm2 =
        bone.share_into_bone * energy_j_ / (dt_s * std::max(bone.least_area_mm2, area_mm2_ / working_ticks_));
  if (irrigated_) {
    surface.film_w_mm2_k = bone.saline_film_w_m2_k * 1e-6;
    surface.around_k = bone.saline_c - bone.body_c;
  }
  column_.step(bone, surface, advance_mm_, dt_s);
  ticks_ = working_ticks_ = 0;
  energy_j_ = area_mm2_ = advance_mm_ = 0.0;
  irrigated_ = false;
}

}  // namespace ream::force
