#include "score/contact_spread.hpp"

#include <optional>

namespace ream::score {

void ContactSpread::add(const record::TickReport& r, const Vec3& apex_mm) {
  if (r.engaged && !r.paused) box_mm_.include(apex_mm);
}

void ContactSpread::write(MetricResults& results) const {
  std::optional<double> spread_mm;
  if (!box_mm_.empty()) spread_mm = (box_mm_.max - box_mm_.min).norm();
  results.set_or_missing("contact_spread_mm", spread_mm, "the reamer touched no bone");
}

}  // namespace ream::score
