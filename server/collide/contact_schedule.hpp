#pragma once
#include <span>
#include <vector>

#include "collide/contact_blocks.hpp"
#include "collide/odometer.hpp"

namespace ream::collide {

/// Decides which blocks of the shell a look for contact must visit. A block whose probes were measured to lie
/// some way off the bone cannot touch before the tool has moved that far, for bone only becomes less; it is
/// left alone until then. So a tick's work follows what touches and what nearly does, not the size of the
/// tool. Culling changes no result. Runs on the host, the same for every narrow phase; no allocation after
/// construction.
class ContactSchedule {
 public:
  /// Blocks measured a look: bounds the work of a tick that finds many of them free. Others are merely
  /// visited again.
  static constexpr int measures_a_look = 24;

  explicit ContactSchedule(const NarrowPhaseInput& input);

  /// Blocks to visit at this pose, in rising order; the list stays valid until the next call.
  std::span<const SurvivingBlock> due(const QuantisedPose& grid_from_tool, const Voi& voi,
                                      const VoxelTransform& transform) noexcept;
  /// After the visits: `engaged(i)` says whether entry i of due() has engaged points. Measures free blocks
  /// with `clear` of the view of this look.
  template <class Engaged>
  void visited(const ContactView& view, IsClear clear, Engaged engaged) noexcept {
    int measures = measures_a_look;
    for (size_t i = 0; i < count_ && measures > 0; ++i) {
      // Begin where the last look ended, so that all have their turn.
      const size_t k = (i + turn_) % count_;
      if (engaged(k)) continue;
      measure(view, clear, list_[k]);
      if (--measures == 0) turn_ = (k + 1) % count_;
    }
  }

 private:
  void measure(const ContactView& view, IsClear clear, const SurvivingBlock& at) noexcept;

  const NarrowPhaseInput in_;
  Odometer odometer_;
  std::vector<float> due_at_;  ///< odometer reading at which a block may touch again
  std::vector<SurvivingBlock> list_;
  size_t count_ = 0, turn_ = 0;
};

}  // namespace ream::collide
