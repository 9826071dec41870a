#pragma once
#include <span>
#include <vector>

#include "collide/contact/broad_phase.hpp"
#include "collide/contact/contact_kernel.hpp"
#include "collide/grid_transform.hpp"

namespace ream::collide {

/// Decides which chunks of the shell a look for contact must visit. A chunk whose probes were measured to lie
/// some way off the bone cannot touch before the tool has moved that far, for bone only becomes less; it is
/// left alone until then. So a tick's work follows what touches and what nearly does, not the size of the
/// tool. Culling changes no result. Runs on the host, the same for every narrow phase; no allocation after
/// construction.
class ContactSchedule {
 public:
  explicit ContactSchedule(const NarrowPhaseInput& input);

  /// Chunks to visit at this pose, in rising order; the list stays valid until the next call.
  std::span<const DueChunk> due(const QuantisedPose& grid_from_tool, const Voi& voi,
                                const VoxelTransform& transform) noexcept;
  /// After the visits, with the view of the same look: touched[i] is 0 for entries of due() that have no
  /// engaged points. Some of them are measured.
  void visited(const ContactView& view, IsClear is_clear, std::span<const uint8_t> touched) noexcept;

 private:
  void list_block(uint32_t number, float now, const Culling& culling,
                  const VoxelTransform& transform) noexcept;
  void measure(const ContactView& view, IsClear is_clear, const DueChunk& chunk) noexcept;
  bool worth_measuring(Clearance clearance) const noexcept;
  void rebase() noexcept;

  const NarrowPhaseInput in_;
  Odometer odometer_;
  /// Odometer readings: when a chunk may touch again, the least of a block's chunks (or less), and when a
  /// block's sphere is to be held against the distance to bone again.
  std::vector<float> chunk_due_at_, block_due_at_, gap_due_at_;
  std::vector<uint8_t> late_;  ///< per block of the look under way, rounded up to eight: has due chunks
  std::vector<DueChunk> list_;
  size_t count_ = 0, turn_ = 0;
  float moved_voxels_ = 0.0f;  ///< since the look before
};

}  // namespace ream::collide
