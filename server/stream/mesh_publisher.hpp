#pragma once
#include <cstdint>
#include <vector>

#include "stream/fanout.hpp"
#include "surface/block_mesh.hpp"
#include "voxel/replica.hpp"

namespace ream::stream {

struct MeshPublisherOptions {
  int noticeable_coverage = 32;  ///< levels that a voxel must change to show at once: 1/8 voxel of surface
  int64_t max_delay_ns = 250'000'000;    ///< smaller changes show after this
  int64_t min_interval_ns = 40'000'000;  ///< between two updates, so that extraction leaves time to others
};

/// Follows the bone through the brick ring and publishes the surface of what changed. All changed blocks are
/// published together, so what viewers hold is always a closed surface of one state of the replica. Used by
/// one thread.
class MeshPublisher {
 public:
  /// `bone` as it is before the first tick; its coverage is copied here.
  MeshPublisher(const voxel::BoneModel& bone, voxel::BrickRing& ring, Fanout& fanout,
                MeshPublisherOptions options = {});

  /// Publishes the first whole picture. Call once, before poll().
  void publish_all();
  /// Takes in all bricks that wait and publishes the changed blocks when they are due. `now_ns` as
  /// steady_ns(); call every 10 ms or so. Returns the number of blocks published.
  size_t poll(int64_t now_ns);
  /// Takes in all bricks that wait and publishes at once: at the end of a session, when the haptic thread
  /// rests.
  size_t flush(int64_t now_ns);

  const voxel::Replica& replica() const { return replica_; }

 private:
  void drain(int64_t now_ns);
  int largest_change(const voxel::BrickImage& image);
  size_t publish_changed(int64_t now_ns);
  bool publish(uint32_t block);

  voxel::Replica replica_;
  voxel::BrickRing& ring_;
  Fanout& fanout_;
  const MeshPublisherOptions options_;
  surface::BlockExtractor extractor_;
  std::vector<uint32_t> revision_;  ///< per block
  std::vector<uint8_t> shown_;      ///< per block: viewers hold a surface of it
  std::vector<uint16_t> moved_;     ///< per brick: coverage levels, at most, since it was published
  std::vector<uint32_t> moved_list_;
  int most_moved_ = 0;
  int64_t moved_since_ns_ = 0, last_publish_ns_ = INT64_MIN / 2;
  uint32_t tick_ = 0;
};

}  // namespace ream::stream
