#pragma once
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "stream/fanout.hpp"
#include "surface/block_mesh.hpp"
#include "voxel/bricks.hpp"

namespace ream::stream {

/// Voxels of a brick, low to high along each axis.
struct VoxelBox {
  Vec3i low, high;
};

/// The box around the voxels, at least one, in which two images of a brick differ; within the brick.
VoxelBox difference_box(const uint8_t* a, const uint8_t* b);

/// Newest images of bricks whose change viewers have not been shown yet, each brick once. Takes memory for
/// those only.
class WaitingBricks {
 public:
  /// `shown` is what viewers hold of that brick, brick_voxels bytes. An image that equals it is not kept.
  void put(const voxel::BrickImage& image, const uint8_t* shown, int64_t now_ns);
  void clear();

  bool empty() const { return images_.empty(); }
  const std::vector<voxel::BrickImage>& images() const { return images_; }
  /// Of them; in a replay it may be earlier than what is shown.
  uint32_t newest_tick() const { return newest_tick_; }
  /// Coverage levels by which any voxel differed from what is shown, at most.
  int max_moved() const { return max_moved_; }
  /// When the first of them was put.
  int64_t since_ns() const { return since_ns_; }

 private:
  std::vector<voxel::BrickImage> images_;
  std::unordered_map<uint32_t, size_t> place_;
  int max_moved_ = 0;
  uint32_t newest_tick_ = 0;
  int64_t since_ns_ = 0;
};

struct MeshPublisherOptions {
  int noticeable_coverage = 64;  ///< levels that a voxel must change to show at once: 1/4 voxel of surface
  int64_t max_delay_ns = 250'000'000;    ///< smaller changes show after this
  int64_t min_interval_ns = 30'000'000;  ///< between two pieces of work, so that others get their turn
  bool with_classes = true;              ///< tells what kind of bone lies under the surface
  int max_surfaces = 24;  ///< blocks that hold any, extracted by one piece of work; coarse ones count less
};

/// Follows the bone by the bricks that it is given and publishes the surface of what changed. Changed bricks
/// wait beside the replica until one of their voxels is noticeable_coverage levels away from what viewers
/// hold, or until the first has waited for max_delay_ns. Then all that wait enter the replica, the blocks
/// whose surface depends on them are extracted, max_surfaces at a time, and when the last is ready those that
/// differ from what viewers hold are published together. So viewers always hold the surface of one coverage,
/// closed and with borders equal to the bit. The same holds at the coarser strides, which are extracted from
/// when the first viewer asks for them. Used by one thread.
class MeshPublisher {
 public:
  /// `bone` as it is when it begins to be followed; its coverage is copied here. `before`: its coverage, in
  /// the same order, before the first tick, where that was not now: what is gone since then is told.
  MeshPublisher(const voxel::BoneModel& bone, Fanout& fanout, MeshPublisherOptions options = {},
                const std::vector<uint8_t>* before = nullptr);

  MeshPublisher(const MeshPublisher&) = delete;
  MeshPublisher& operator=(const MeshPublisher&) = delete;

  /// A brick as it is now, more bone than before or less.
  void take(const voxel::BrickImage& image, int64_t now_ns);

  /// Publishes the first whole picture. Call once, before poll().
  void publish_all();
  /// Does one piece of work if there is any. `now_ns` as steady_ns(); call every 10 ms or so. Returns the
  /// number of blocks published.
  size_t poll(int64_t now_ns);
  /// Publishes all that was taken, at once: at the end of a session, when the haptic thread rests.
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

  void keep_changed(const std::vector<uint8_t>& before);
  bool due(int64_t now_ns) const;
  bool extracting() const;
  /// The first picture of strides that a viewer has come to ask for.
  void begin_pictures();
  void begin_update();
  /// What counts is a surface of stride 1.
  void extract(int max_surfaces);
  size_t publish_ready();

  voxel::Replica replica_;
  const SurfaceClasses classes_;
  RemovedBone removed_;
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
