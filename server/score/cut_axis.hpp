#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "geometry/pose.hpp"

namespace ream::score {

/// The line along which a tool cut last.
struct CutLine {
  Vec3 apex_mm = Vec3::Zero();     ///< mean place of the tool's apex
  Vec3 direction = Vec3::UnitZ();  ///< unit, mean feed direction, into the bone
  double deepest_mm = 0.0;         ///< the apex's greatest z while it removed

  /// The point of the line that is as deep as the apex ever was.
  Vec3 deepest_apex_mm() const;
};

/// Achieved axis: a sphere has no axis of its own, so it is the tool's, as a mean weighted by
/// removed volume over the last 0.5 mm of advance. Advance is counted along z of the plan frame, and what was
/// removed anywhere within 0.5 mm of the deepest apex counts, whenever it was (in steps of 0.01 mm).
class CutAxis {
 public:
  static constexpr double window_mm = 0.5;

  /// Once a tick: the tool in the plan frame of the bone at rest, and how much it removed (any unit).
  void add(const Pose& plan_from_tool, int64_t removed);
  /// Plan frame; empty while nothing was removed.
  std::optional<CutLine> line() const;

 private:
  static constexpr int64_t steps = 50;
  static constexpr double step_mm = window_mm / steps;

  /// What was removed while the apex was within one step of depth.
  struct Step {
    double weight = 0.0;
    Vec3 apex_sum_mm = Vec3::Zero(), direction_sum = Vec3::Zero();
  };

  std::array<Step, steps> steps_{};  ///< of the last 0.5 mm, step i at i modulo their number
  bool removed_ = false;
  int64_t deepest_step_ = 0;
  double deepest_mm_ = 0.0;
};

}  // namespace ream::score
