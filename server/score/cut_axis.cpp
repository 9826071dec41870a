#include "score/cut_axis.hpp"

#include <algorithm>
#include <cmath>

namespace ream::score {
namespace {

constexpr int64_t place(int64_t step, int64_t steps) { return (step % steps + steps) % steps; }

}  // namespace

Vec3 CutLine::deepest_apex_mm() const {
  if (std::abs(direction.z()) < 1e-6) return apex_mm;
  return apex_mm + (deepest_mm - apex_mm.z()) / direction.z() * direction;
}

void CutAxis::add(const Pose& plan_from_tool, int64_t removed) {
  if (removed <= 0) return;
  const Vec3& apex_mm = plan_from_tool.translation_mm;
  const auto step = static_cast<int64_t>(std::floor(apex_mm.z() / step_mm));
  if (!removed_) {
    deepest_step_ = step;
    deepest_mm_ = apex_mm.z();
    removed_ = true;
  }
  if (step <= deepest_step_ - steps) return;
  for (int64_t s = std::max(deepest_step_ + 1, step - steps + 1); s <= step; ++s)
    steps_[static_cast<size_t>(place(s, steps))] = {};
  deepest_step_ = std::max(deepest_step_, step);
  deepest_mm_ = std::max(deepest_mm_, apex_mm.z());
  Step& at = steps_[static_cast<size_t>(place(step, steps))];
  const auto weight = static_cast<double>(removed);
  at.weight += weight;
  at.apex_sum_mm += weight * apex_mm;
  at.direction_sum += weight * plan_from_tool.rotation.col(2);
}

std::optional<CutLine> CutAxis::line() const {
  if (!removed_) return std::nullopt;
  Step all;
  for (int64_t s = deepest_step_ - steps + 1; s <= deepest_step_; ++s) {
    const Step& one = steps_[static_cast<size_t>(place(s, steps))];
    all.weight += one.weight;
    all.apex_sum_mm += one.apex_sum_mm;
    all.direction_sum += one.direction_sum;
  }
  if (!(all.weight > 0.0) || !(all.direction_sum.norm() > 1e-6 * all.weight)) return std::nullopt;
  return CutLine{all.apex_sum_mm / all.weight, all.direction_sum.normalized(), deepest_mm_};
}

}  // namespace ream::score
