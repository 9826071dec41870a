#include "stream/mesh_publisher.hpp"

#include <algorithm>
#include <cstdlib>

namespace ream::stream {

MeshPublisher::MeshPublisher(const voxel::BoneModel& bone, voxel::BrickRing& ring, Fanout& fanout,
                             MeshPublisherOptions options)
    : replica_(bone),
      ring_(ring),
      fanout_(fanout),
      options_(options),
      extractor_(bone.grid),
      revision_(replica_.block_count()),
      shown_(replica_.block_count()),
      moved_(bone.grid.brick_count()) {}

void MeshPublisher::publish_all() {
  for (uint32_t block = 0; block < replica_.block_count(); ++block) publish(block);
  fanout_.publish_picture_complete();
}

size_t MeshPublisher::poll(int64_t now_ns) {
  drain(now_ns);
  if (moved_list_.empty() || now_ns - last_publish_ns_ < options_.min_interval_ns) return 0;
  const bool due =
      most_moved_ >= options_.noticeable_coverage || now_ns - moved_since_ns_ >= options_.max_delay_ns;
  return due ? publish_changed(now_ns) : 0;
}

size_t MeshPublisher::flush(int64_t now_ns) {
  drain(now_ns);
  return publish_changed(now_ns);
}

void MeshPublisher::drain(int64_t now_ns) {
  voxel::BrickImage image;
  while (ring_.try_pop(image)) {
    tick_ = std::max(tick_, image.tick);
    const int change = largest_change(image);
    if (change == 0) continue;
    replica_.apply(image);
    if (moved_list_.empty()) moved_since_ns_ = now_ns;
    uint16_t& moved = moved_[image.brick];
    if (moved == 0) moved_list_.push_back(image.brick);
    moved = static_cast<uint16_t>(std::min(moved + change, int{UINT16_MAX}));
    most_moved_ = std::max(most_moved_, int{moved});
  }
}

int MeshPublisher::largest_change(const voxel::BrickImage& image) {
  uint8_t before[voxel::brick_voxels];
  voxel::read_brick(replica_.grid(), replica_.coverage().data(), image.brick, before);
  int largest = 0;
  for (int i = 0; i < voxel::brick_voxels; ++i)
    largest = std::max(largest, std::abs(before[i] - image.coverage[i]));
  return largest;
}

size_t MeshPublisher::publish_changed(int64_t now_ns) {
  size_t published = 0;
  for (const uint32_t block : replica_.take_dirty_blocks()) published += publish(block);
  for (const uint32_t brick : moved_list_) moved_[brick] = 0;
  moved_list_.clear();
  most_moved_ = 0;
  last_publish_ns_ = now_ns;
  return published;
}

bool MeshPublisher::publish(uint32_t block) {
  const surface::BlockMesh mesh = extractor_.extract(replica_.coverage().data(), block);
  const bool holds_surface = !mesh.indices.empty();
  if (!holds_surface && !shown_[block]) return false;
  shown_[block] = holds_surface;
  fanout_.publish_block(std::make_shared<const EncodedBlock>(encode(mesh, ++revision_[block], tick_)));
  return true;
}

}  // namespace ream::stream
