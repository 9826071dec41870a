#include "score/path_economy.hpp"

#include <algorithm>
#include <optional>

#include "score/tool_path.hpp"

namespace ream::score {
namespace {

bool removes(const record::TickReport& r) {
  return r.coverage_removed[0] + r.coverage_removed[1] + r.coverage_removed[2] > 0;
}

std::optional<double> percent_of(double shortest_mm, double path_mm) {
  return path_mm > 0.0 ? std::optional(100.0 * shortest_mm / path_mm) : std::nullopt;
}

}  // namespace

double PathEconomy::Stretch::shortest_mm() const {
  if (!removed) return (to_mm - from_mm).norm();
  return (deepest_mm - from_mm).norm() + (to_mm - deepest_mm).norm();
}

void PathEconomy::add(const record::TickReport& r, const Vec3& apex_mm, double axial_mm) {
  const double step_mm = stretch_.begun ? (apex_mm - stretch_.to_mm).norm() : 0.0;
  if (stretch_.begun && (r.paused || step_mm > ToolPath::max_step_mm)) {
    shortest_before_mm_ += stretch_.shortest_mm();
    stretch_ = {};
  }
  if (r.paused) return;
  if (stretch_.begun) {
    path_mm_ += step_mm;
    if (r.engaged) {
      path_in_contact_mm_ += step_mm;
      const double reached_mm =
          touched_ ? std::max(deepest_in_contact_mm_, stretch_.axial_mm) : stretch_.axial_mm;
      gained_mm_ += std::max(0.0, axial_mm - reached_mm);
    }
  } else {
    stretch_.begun = true;
    stretch_.from_mm = apex_mm;
  }
  stretch_.to_mm = apex_mm;
  stretch_.axial_mm = axial_mm;
  if (r.engaged) {
    deepest_in_contact_mm_ = touched_ ? std::max(deepest_in_contact_mm_, axial_mm) : axial_mm;
    touched_ = true;
  }
  if (!removes(r)) return;
  removed_ = true;
  if (stretch_.removed && axial_mm <= stretch_.deepest_axial_mm) return;
  stretch_.removed = true;
  stretch_.deepest_mm = apex_mm;
  stretch_.deepest_axial_mm = axial_mm;
}

void PathEconomy::write(MetricResults& results) const {
  std::optional<double> in_contact, whole;
  if (removed_) {
    in_contact = percent_of(gained_mm_, path_in_contact_mm_);
    whole = percent_of(shortest_before_mm_ + stretch_.shortest_mm(), path_mm_);
  }
  const char* why = removed_ ? "the tool did not move" : "no bone was removed";
  results.set_or_missing("path_economy_contact_percent", in_contact, why);
  results.set_or_missing("path_economy_percent", whole, why);
}

}  // namespace ream::score
