#pragma once
#include "geometry/box.hpp"
#include "record/tick_report.hpp"
#include "score/metric_results.hpp"

namespace ream::score {

/// Over how much of the bone the reamer was in contact: the diagonal of the box, along the axes of the world,
/// around its apex while it touched bone.
class ContactSpread {
 public:
  /// Once a tick. `apex_mm`: in the frame of the bone at rest.
  void add(const record::TickReport& report, const Vec3& apex_mm);
  void write(MetricResults& results) const;

 private:
  Aabb box_mm_;
};

}  // namespace ream::score
