#pragma once
#include <optional>
#include <vector>

#include "score/component.hpp"
#include "score/metric_results.hpp"

namespace ream::score {

/// Why what is compared with the plan is missing.
inline constexpr const char* not_planned = "the case has no plan, or its reamer does not touch the face";

/// What the plan makes of a glenoid, along the rays of its NativeGlenoid: the reamer (Task::reamer, the last
/// that was used) has gone down the planned axis to the planned depth, and the component is seated there.
/// Made once a session.
struct PlannedFace {
  /// Of every ray, mm; 0 off the face. Empty without a plan, or where the planned reamer does not touch it.
  std::vector<double> removed_mm;
  /// Of the component on it: seating, share of the footprint with at least half of the plate, share of the
  /// plate's bone under it that is left.
  std::optional<double> seating_percent, plate_percent, plate_left_percent;
  std::optional<double> joint_line_mm;  ///< of the same component, see joint_line.hpp

  bool known() const { return !removed_mm.empty(); }
};

PlannedFace planned_face(const NativeGlenoid& native);

/// The face as the planned reamer leaves it, and the plan's axis at its deepest in the frame of the lattice.
/// Empty without a plan, or where its reamer does not touch the face.
struct PlannedCut {
  AchievedFace face;
  CutLine line;
};
std::optional<PlannedCut> planned_cut(const NativeGlenoid& native);

/// Share of a footprint in which at least half of the subchondral plate is left, percent; empty without rays.
std::optional<double> plate_preserved_percent(const NativeGlenoid& native,
                                              const std::vector<double>& removed_mm,
                                              const std::vector<size_t>& footprint);

/// What the plan itself reaches: known before the session begins.
void measure_planned_face(const PlannedFace& planned, MetricResults& results);

/// What was removed against what the plan removes, over the face; the plate under the component, and seating
/// as it stands in `results`, against the planned ones.
void measure_against_plan(const NativeGlenoid& native, const PlannedFace& planned, const AchievedFace& face,
                          const Component& component, MetricResults& results);

}  // namespace ream::score
