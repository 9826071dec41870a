#pragma once
#include <array>
#include <cstddef>

#include "geometry/pose.hpp"

namespace ream::force {

/// Bone that warms under the reamer. Measured spread in brackets.
struct HeatSettings {
  /// [0.3 to 0.8] W/(m K): cortical 0.55 (Lee 2018), cancellous 0.29 (Clattenburg 1975).
  double conductivity_w_m_k = 0.5;
  /// [2.3 to 3.1] MJ/(m3 K): cancellous 3.06 (Clattenburg 1975).
  double heat_capacity_mj_m3_k = 2.6;
  /// [0.3 to 0.7] Part of the spindle's power that goes into the bone under the lips. Engineering choice.
  double share_into_bone = 0.5;
  /// [100 to 1000] W/(m2 K), from the surface to saline that runs over it. Engineering choice.
  double saline_film_w_m2_k = 300.0;
  /// A smaller contact wanders about as much, and its heat spreads sideways. Engineering choice.
  double least_area_mm2 = 50.0;
  double body_c = 35.0, saline_c = 22.0;
};

/// Bone dies at once (Eriksson & Albrektsson; alkaline phosphatase); where it does within a minute.
inline constexpr double dead_at_once_c = 56.0, dead_in_a_minute_c = 47.0;

/// What passes through the surface into the bone: flux + film (around - surface temperature).
struct HeatSurface {
  double flux_w_mm2 = 0.0, film_w_mm2_k = 0.0;
  double around_k = 0.0;  ///< over the body's temperature, as all temperatures here
};
/// As good as a surface held at `around_k`.
inline constexpr double holding_film_w_mm2_k = 1e3;

/// Temperature below a surface that sinks into bone (mechanics: rho c dT/dt = d/dx (k dT/dx) + rho c v
/// dT/dx), in cells that grow from 0.04 mm to 2.3 mm, down to 27 mm. Each step is implicit: stable for any
/// step and advance. What is heated stays or leaves with the chips, which are as warm as the first cell.
class HeatColumn {
 public:
  static constexpr size_t cells = 48;

  /// `advance_mm`: how far the surface sinks in this time, not negative.
  void step(const HeatSettings& bone, const HeatSurface& surface, double advance_mm, double dt_s) noexcept;

  double surface_k() const noexcept { return surface_k_; }
  double excess_k(size_t cell) const noexcept { return excess_k_[cell]; }
  static double width_mm(size_t cell) noexcept;
  /// How deep below the surface as it is now bone has ever been at dead_at_once_c or more.
  double dead_depth_mm() const noexcept { return dead_depth_mm_; }

 private:
  void solve(const HeatSettings& bone, const HeatSurface& surface, double advance_mm, double dt_s) noexcept;
  double depth_over_mm(double excess_k) const noexcept;

  std::array<double, cells> excess_k_{};
  double surface_k_ = 0.0, dead_depth_mm_ = 0.0;
};

/// What a tick does to the bone under the reamer.
struct HeatTick {
  double power_w = 0.0;     ///< of the spindle against the bone
  double area_mm2 = 0.0;    ///< that the cutting surface engages
  double advance_mm = 0.0;  ///< of the surface into the bone
  bool irrigated = false;
  Vec3 apex_mm = Vec3::Zero(), axis = Vec3::UnitZ();  ///< of the tool, in the bone's frame
};

/// The bone that the reamer has been on since it was set down: the warmest, as bone that a growing contact
/// reaches later has had less. It is one column with the mean flux over the engaged area. It goes on when the
/// tool is lifted and set down again; farther aside than the contact's radius is another, cold place, whose
/// first ticks have exactly body_c. Only + - * /: the same bits everywhere.
class HeatedBone {
 public:
  static constexpr int ticks_a_step = 10;

  void add(const HeatSettings& bone, const HeatTick& tick) noexcept;
  double surface_c(const HeatSettings& bone) const noexcept { return bone.body_c + column_.surface_k(); }
  const HeatColumn& column() const noexcept { return column_; }

 private:
  bool elsewhere(const HeatTick& tick) const noexcept;

  HeatColumn column_;
  bool placed_ = false;
  Vec3 place_mm_ = Vec3::Zero();
  double largest_area_mm2_ = 0.0;
  // Since the last step of the column.
  int ticks_ = 0;
  double energy_j_ = 0.0, area_mm2_ = 0.0, advance_mm_ = 0.0;
  int working_ticks_ = 0;
  bool irrigated_ = false;
};

}  // namespace ream::force
