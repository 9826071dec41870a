#include "score/breakthrough.hpp"

#include <algorithm>

#include "core/clock.hpp"
#include "voxel/bone_model.hpp"

namespace ream::score {
namespace {

bool presses(const record::TickReport& r) { return r.engaged && r.spindle_on && r.thrust_n >= pressing_n; }

double share(const record::TickReport& r, voxel::BoneClass bone_class) {
  return r.share[static_cast<size_t>(bone_class)];
}

}  // namespace

void AdvanceUntilRelease::begin(double axial_mm) {
  begun_ = true;
  from_mm_ = deepest_mm_ = axial_mm;
}

void AdvanceUntilRelease::add(const record::TickReport& r, double axial_mm) {
  if (!begun_ || advance_) return;
  ++ticks_;
  if (r.engaged) deepest_mm_ = std::max(deepest_mm_, axial_mm);
  if (!r.engaged || r.thrust_n < pressing_n)
    advance_ = Advance{deepest_mm_ - from_mm_, static_cast<double>(ticks_) * tick_s};
}

void Breakthrough::add(const record::TickReport& r, double axial_mm) {
  if (inside_.begun())
    inside_.add(r, axial_mm);
  else if (presses(r) && share(r, voxel::BoneClass::cancellous) >= reached_share)
    inside_.begin(axial_mm);
}

void PlateStop::add(const record::TickReport& r, double axial_mm) {
  if (beyond_.begun()) return beyond_.add(r, axial_mm);
  if (!presses(r)) return;
  cartilage_ = cartilage_ || share(r, voxel::BoneClass::cartilage) >= reached_share;
  const double bone = share(r, voxel::BoneClass::cancellous) + share(r, voxel::BoneClass::cortical);
  if (cartilage_ && bone >= reached_share) beyond_.begin(axial_mm);
}

}  // namespace ream::score
