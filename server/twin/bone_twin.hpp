#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "collide/removal/removal.hpp"
#include "collide/removal/removal_schedule.hpp"
#include "geometry/pose.hpp"
#include "shell/swept_profile.hpp"
#include "surface/block_mesh.hpp"
#include "voxel/bone_model.hpp"

namespace ream::twin {

/// What decided about the bone in one tick, of ops::Tick.
struct CauseTick {
  uint32_t tick = 0;
  uint32_t flags = 0;  ///< record::TickFlag
  QuantisedPose grid_from_tool;
};

/// The bone of a session, computed again from its causes: the same removal, the same bits, without contact
/// and force. Compiles to WebAssembly (twin/wasm), so that a browser can follow a session, or prove a
/// recording. Only for sessions whose bone is removed by the swept profile, not by decay. One thread.
class BoneTwin {
 public:
  /// `bone`: before the first tick, the pilot hole gone; its density only tells classes and may be zeros.
  explicit BoneTwin(voxel::BoneModel bone);

  /// A tool made anew reams what is left (ops::Segment); before the first tick and wherever a recording says
  /// so. `profile` as the session's own, with RemovalSchedule::needed_margin_mm.
  void begin_segment(shell::SweptProfile profile);

  /// One tick; the session's rolling hash after it. Needs a segment.
  uint64_t step(const CauseTick& cause) noexcept;

  uint64_t session_hash() const { return session_hash_; }
  const voxel::BoneModel& bone() const { return bone_; }

  /// For pictures without a stream of meshes: surface blocks that may have changed since the last call,
  /// ascending; all of them at first.
  std::vector<uint32_t> take_changed_blocks();
  surface::BlockMesh surface_of(uint32_t block);  ///< below block_count()
  uint32_t block_count() const { return extractor_.layout().count(); }

 private:
  /// What works on the bone with one tool.
  struct Reaming {
    Reaming(shell::SweptProfile of_tool, voxel::BoneModel& bone);
    shell::SweptProfile profile;
    collide::RemovalSchedule schedule;
    std::unique_ptr<collide::Removal> removal;
  };

  void cut(const QuantisedPose& grid_from_tool) noexcept;
  void note_change(uint32_t brick) noexcept;

  voxel::BoneModel bone_;
  surface::BlockExtractor extractor_;
  std::unique_ptr<Reaming> reaming_;
  std::vector<uint8_t> block_changed_;  ///< of each surface block
  uint64_t session_hash_ = 0;
};

}  // namespace ream::twin
