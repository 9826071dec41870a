#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "collide/removal/removal.hpp"
#include "collide/removal/removal_schedule.hpp"
#include "geometry/pose.hpp"
#include "shell/swept_profile.hpp"
#include "stream/removed_bone.hpp"
#include "stream/surface_classes.hpp"
#include "surface/block_mesh.hpp"
#include "voxel/bone_model.hpp"

namespace ream::twin {

/// What decided about the bone in one tick, of ops::Tick.
struct CauseTick {
  uint32_t tick = 0;
  uint32_t flags = 0;  ///< record::TickFlag
  QuantisedPose grid_from_tool;
};

/// A block's surface as viewers draw it, with what MeshBlock of proto/stream.fbs says of its vertices.
struct MarkedSurface {
  surface::BlockMesh mesh;
  std::vector<uint8_t> classes;    ///< empty: no density is known
  std::vector<uint8_t> removed;    ///< empty: nothing is gone
  std::vector<uint8_t> densities;  ///< empty where one of those is
};

/// The bone of a session, computed again from its causes: the same removal, the same bits, without contact
/// and force. Compiles to WebAssembly (twin/wasm), so that a browser can follow a session, or prove a
/// recording. Only for sessions whose bone is removed by the swept profile, not by decay. One thread.
class BoneTwin {
 public:
  /// `bone`: before the first tick, the pilot hole gone. Its density colours pictures and decides nothing.
  explicit BoneTwin(voxel::BoneModel bone);
  BoneTwin(const BoneTwin&) = delete;
  BoneTwin& operator=(const BoneTwin&) = delete;

  /// For pictures: what the bone is made of, grid.voxel_count() codes. Before the first segment.
  void tell_density(std::vector<uint8_t> density, double cortical_threshold_g_cc);

  /// A tool made anew reams what is left (ops::Segment); before the first tick and wherever a recording says
  /// so. `profile` as the session's own, with RemovalSchedule::needed_margin_mm.
  void begin_segment(shell::SweptProfile profile);

  /// One tick; the session's rolling hash after it. Needs a segment.
  uint64_t step(const CauseTick& cause) noexcept;

  uint64_t session_hash() const { return session_hash_; }
  const voxel::BoneModel& bone() const { return bone_; }

  /// Keeps what there is now, so that go_to() leads here; its number. After go_to() the same ticks must
  /// follow as before: the next one kept then is the one that is there already.
  size_t keep_snapshot();
  /// Back, or forward, to a snapshot. Costs what changed since the first.
  void go_to(size_t snapshot);

  /// For pictures without a stream of meshes: surface blocks that may have changed since the last call,
  /// ascending; all of them at first.
  std::vector<uint32_t> take_changed_blocks();
  MarkedSurface surface_of(uint32_t block);  ///< below block_count()
  /// The same as surface::whole_surface at stride 1, for maps that go by its vertices.
  TriangleMesh whole_surface();
  uint32_t block_count() const { return extractor_.layout().count(); }

 private:
  /// What works on the bone with one tool. Copies share what does not change.
  struct Reaming {
    Reaming(shell::SweptProfile of_tool, voxel::BoneModel& bone);
    std::shared_ptr<const shell::SweptProfile> profile;
    std::shared_ptr<collide::Removal> removal;
    collide::RemovalSchedule schedule;
  };
  /// Bone by its bricks that changed since the one before.
  struct Snapshot {
    uint64_t session_hash = 0;
    std::unique_ptr<const Reaming> reaming;
    std::vector<uint32_t> bricks;
    std::vector<uint8_t> coverage;  ///< brick_voxels bytes each
  };

  uint8_t* coverage_of(uint32_t brick) noexcept;
  void cut(const QuantisedPose& grid_from_tool) noexcept;
  void note_change(uint32_t brick) noexcept;
  void show_change(uint32_t brick) noexcept;

  voxel::BoneModel bone_;
  surface::BlockExtractor extractor_;
  stream::RemovedBone removed_;
  std::optional<stream::SurfaceClasses> classes_;
  std::unique_ptr<Reaming> reaming_;
  std::vector<uint8_t> block_changed_;  ///< of each surface block
  uint64_t session_hash_ = 0;
  std::vector<Snapshot> snapshots_;
  size_t snapshots_passed_ = 0;
  std::vector<uint8_t> is_changed_;  ///< of each brick, since the last snapshot
  std::vector<uint32_t> changed_;
};

}  // namespace ream::twin
