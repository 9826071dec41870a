#pragma once
#include "record/tick_report.hpp"
#include "score/metric_results.hpp"

namespace ream::score {

/// Economy of movement: the shortest path that the task needs over the path that the tool's apex went, in the
/// bone's frame; 1 is the best. While the reamer touches bone the task needs to get deeper along the planned
/// axis, and only that. Over the whole session it needs to come straight from where it began to the deepest
/// place where bone was removed, and to go straight to where it ended. A pause, or a step of more than 1 mm
/// in one tick, parts a session into stretches, each of which has a path and a shortest path of its own.
class PathEconomy {
 public:
  /// Once a tick. `apex_mm`: in the frame of the bone at rest; `axial_mm`: the same along the planned axis.
  void add(const record::TickReport& report, const Vec3& apex_mm, double axial_mm);
  void write(MetricResults& results) const;

 private:
  /// What went on without a break.
  struct Stretch {
    Vec3 from_mm = Vec3::Zero(), to_mm = Vec3::Zero(), deepest_mm = Vec3::Zero();
    double axial_mm = 0.0, deepest_axial_mm = 0.0;
    bool begun = false, removed = false;

    double shortest_mm() const;
  };

  Stretch stretch_;
  double shortest_before_mm_ = 0.0;  ///< of stretches that have ended
  double path_mm_ = 0.0, path_in_contact_mm_ = 0.0, gained_mm_ = 0.0;
  double deepest_in_contact_mm_ = 0.0;  ///< along the planned axis
  bool touched_ = false, removed_ = false;
};

}  // namespace ream::score
