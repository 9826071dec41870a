#pragma once
#include <cstdint>
#include <vector>

#include "stream/fanout.hpp"
#include "stream/waiting_bricks.hpp"
#include "surface/block_mesh.hpp"
#include "voxel/replica.hpp"

namespace ream::stream {

struct MeshPublisherOptions {
  int noticeable_coverage = 64;  ///< levels that a voxel must change to show at once: 1/4 voxel of surface
  int64_t max_delay_ns = 250'000'000;    ///< smaller changes show after this
  int64_t min_interval_ns = 30'000'000;  ///< between two pieces of work, so that others get their turn
  int max_surfaces = 24;  ///< blocks that hold any, extracted by one piece of work; coarse ones count less
};

/// Follows the bone through the brick ring and publishes the surface of what changed. Changed bricks wait
/// beside the replica until one of their voxels is noticeable_coverage levels away from what viewers hold, or
/// until the first has waited for max_delay_ns. Then all that wait enter the replica, the blocks whose
/// surface depends on them are extracted, max_surfaces at a time, and when the last is ready those that
/// differ from what viewers hold are published together. So viewers always hold the surface of one coverage,
/// closed and with borders equal to the bit. The same holds at the coarser strides, which are extracted from
/// when the first viewer asks for them. Used by one thread.
class MeshPublisher {
 public:
  /// `bone` as it is before the first tick; its coverage is copied here.
  MeshPublisher(const voxel::BoneModel& bone, voxel::BrickRing& ring, Fanout& fanout,
                MeshPublisherOptions options = {});

  /// The same without a ring: changed bricks come by take().
  MeshPublisher(const voxel::BoneModel& bone, Fanout& fanout, MeshPublisherOptions options = {});

  /// A brick as it is now, more bone than before or less.
  void take(const voxel::BrickImage& image, int64_t now_ns);

  /// Publishes the first whole picture. Call once, before poll().
  void publish_all();
  /// Takes in all bricks that wait in the ring, then does one piece of work if there is any. `now_ns` as
  /// steady_ns(); call every 10 ms or so. Returns the number of blocks published.
  size_t poll(int64_t now_ns);
  /// Takes in all bricks that wait and publishes at once: at the end of a session, when the haptic thread
  /// rests.
  size_t flush(int64_t now_ns);

  /// What viewers hold, or will once the update in progress is published.
  const voxel::Replica& replica() const { return replica_; }

 private:
  /// The surface at one stride.
  struct Level {
    Level(const voxel::VoxelGrid& grid, int stride_voxels);

    int stride;
    surface::BlockExtractor extractor;
    enum class Picture { unwanted, begun, complete } picture = Picture::unwanted;
    std::vector<uint32_t> revision;    ///< per block
    std::vector<uint64_t> shown;       ///< per block: hash of the surface that viewers hold, 0 for none
    std::vector<uint32_t> to_extract;  ///< blocks of the update in progress, from `next` on
    size_t next = 0;
    std::vector<uint8_t> is_touched;  ///< per block: in to_extract
    void touch(uint32_t block);
  };

  MeshPublisher(const voxel::BoneModel& bone, voxel::BrickRing* ring, Fanout& fanout,
                MeshPublisherOptions options);
  void drain(int64_t now_ns);
  bool due(int64_t now_ns) const;
  bool extracting() const;
  /// The first picture of strides that a viewer has come to ask for.
  void begin_pictures();
  void begin_update();
  /// What counts is a surface of stride 1.
  void extract(int most_surfaces);
  size_t publish_ready();

  voxel::Replica replica_;
  const SurfaceClasses classes_;
  voxel::BrickRing* const ring_;  ///< null: bricks come by take() only
  Fanout& fanout_;
  const MeshPublisherOptions options_;
  surface::BlockLayout layout_;
  std::vector<Level> levels_;  ///< of strides 1, 2, 4
  WaitingBricks waiting_;
  uint32_t tick_ = 0;
  int64_t last_work_ns_ = INT64_MIN / 2;

  std::vector<SharedBlock> ready_;  ///< of the update in progress
};

}  // namespace ream::stream
