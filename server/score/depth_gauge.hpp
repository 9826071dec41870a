#pragma once
#include <memory>
#include <vector>

#include "score/component.hpp"

namespace ream::score {

/// A ray counts as reamed when so much of its face is gone (engineering judgement).
inline constexpr double reamed_mm = 0.05;

/// How deep bone and cartilage are gone along the planned axis, mm.
struct GreatestDepth {
  double removed_mm = 0.0;           ///< from the untouched face on
  double past_subchondral_mm = 0.0;  ///< from the bone under any cartilage on
};

/// Over all rays of the face, where bone is left under them; where it is nowhere left, over all that are
/// reamed. Rays at the edge of a vault that narrows leave the bone sideways; how deep the reamer went is seen
/// where bone is left under it.
GreatestDepth greatest_depth(const NativeGlenoid& native, const AchievedFace& face);

/// How deep the reaming is, of a bone that is being reamed. This is the depth that gauge, alarm, score and
/// report speak of. It is measured on what is gone, so a touch changes nothing, and its zero is where a tool
/// on the planned axis touches the untouched face first: that is the plan's zero, too (first_contact_mm()).
/// Looks at rays 1 mm apart, then at all rays around the deepest of them. Used by one thread.
class DepthGauge {
 public:
  explicit DepthGauge(std::shared_ptr<const NativeGlenoid> native);

  /// greatest_depth().removed_mm but for places less than 1 mm wide. `left`: what remains, with the bone at
  /// rest. Begins at the ray that was deepest before, so that of most others one look says that they are not.
  double measure(const CoverageView& left);
  bool has_face() const { return !coarse_.empty(); }

 private:
  std::shared_ptr<const NativeGlenoid> native_;
  std::vector<size_t> coarse_;  ///< rays of the face
  size_t deepest_ = 0;          ///< among them, in the measurement before
};

}  // namespace ream::score
