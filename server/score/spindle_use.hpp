#pragma once
#include <cstdint>

#include "record/tick_report.hpp"
#include "score/metric_results.hpp"

namespace ream::score {

/// Under this thrust a hand no longer presses.
inline constexpr double pressing_n = 5.0;
/// Why what is averaged over cutting is missing.
inline constexpr const char* never_cut = "the reamer never cut with 5 N";

/// Whether the reamer cuts and is pressed on: resting on the bone is neither.
inline bool is_pressed_cut(const record::TickReport& report) {
  return report.cutting && report.thrust_n >= pressing_n;
}

/// When the spindle turns and when the reamer touches bone: taught is to start it in the air, to cut without
/// breaks, and to stop it once it is withdrawn. A paused session adds nothing.
class SpindleUse {
 public:
  /// Once a tick.
  void add(const record::TickReport& report);
  void write(MetricResults& results) const;

 private:
  void follow_start(const record::TickReport& report);

  int64_t standing_press_ticks_ = 0, air_spin_ticks_ = 0;
  int64_t idle_ticks_ = 0;      ///< without contact, between two contacts
  int64_t ticks_off_bone_ = 0;  ///< since the last contact
  bool touched_ = false, turned_ = false, turning_ = false;
  int restarts_ = 0;
  int64_t withdrawn_spin_ticks_ = 0;  ///< of air_spin_ticks_, after a contact
  /// In contact with a standing spindle since the last start and the last contact that ended: parted only by
  /// more than half a second off the bone.
  int64_t standing_ticks_ = 0;
  int64_t contact_before_spin_ticks_ = 0;
  int starts_in_contact_ = 0;
};

/// How steadily the tool's axis is held while it cuts, in the bone's frame.
class AxisSteadiness {
 public:
  /// Once a tick; `bone_from_tool`: in the frame of the bone at rest.
  void add(const record::TickReport& report, const Pose& bone_from_tool);
  void write(MetricResults& results) const;

 private:
  int64_t ticks_ = 0;
  Vec3 sum_ = Vec3::Zero();  ///< of unit axes
};

}  // namespace ream::score
