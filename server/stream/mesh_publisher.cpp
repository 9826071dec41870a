#include "stream/mesh_publisher.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/hash.hpp"

namespace ream::stream {
namespace {

/// Not 0 unless the mesh is empty.
uint64_t surface_hash(const surface::BlockMesh& mesh) {
  uint64_t hash = mesh.indices.size();
  for (const surface::BlockVertex& v : mesh.vertices) {
    uint64_t word;
    std::memcpy(&word, &v, sizeof word);
    hash = mix64(hash ^ word);
  }
  for (const uint32_t index : mesh.indices) hash = hash * 0x9e3779b97f4a7c15ull + index;
  return mesh.indices.empty() ? 0 : std::max<uint64_t>(hash, 1);
}

}  // namespace

MeshPublisher::MeshPublisher(const voxel::BoneModel& bone, voxel::BrickRing& ring, Fanout& fanout,
                             MeshPublisherOptions options)
    : replica_(bone),
      ring_(ring),
      fanout_(fanout),
      options_(options),
      layout_(bone.grid),
      extractor_(bone.grid),
      revision_(layout_.count()),
      shown_(layout_.count()),
      is_touched_(layout_.count()) {}

void MeshPublisher::publish_all() {
  for (uint32_t block = 0; block < layout_.count(); ++block) to_extract_.push_back(block);
  extract(to_extract_.size());
  publish_ready();
  fanout_.publish_picture_complete();
}

size_t MeshPublisher::poll(int64_t now_ns) {
  drain(now_ns);
  if (now_ns - last_work_ns_ < options_.min_interval_ns) return 0;
  if (to_extract_.empty()) {
    if (!due(now_ns)) return 0;
    begin_update();
  }
  last_work_ns_ = now_ns;
  extract(options_.max_surfaces);
  return next_ == to_extract_.size() ? publish_ready() : 0;
}

size_t MeshPublisher::flush(int64_t now_ns) {
  drain(now_ns);
  extract(to_extract_.size());
  size_t published = publish_ready();
  begin_update();
  extract(to_extract_.size());
  published += publish_ready();
  last_work_ns_ = now_ns;
  return published;
}

void MeshPublisher::drain(int64_t now_ns) {
  voxel::BrickImage image;
  while (ring_.try_pop(image)) waiting_.put(image, replica_.brick(image.brick), now_ns);
}

bool MeshPublisher::due(int64_t now_ns) const {
  return !waiting_.empty() && (waiting_.most_moved() >= options_.noticeable_coverage ||
                               now_ns - waiting_.since_ns() >= options_.max_delay_ns);
}

void MeshPublisher::begin_update() {
  for (const voxel::BrickImage& image : waiting_.images()) {
    const uint8_t* shown = replica_.brick(image.brick);
    if (std::memcmp(shown, image.coverage, voxel::brick_voxels) == 0) continue;
    const VoxelBox box = difference_box(shown, image.coverage);
    tick_ = std::max(tick_, image.tick);
    replica_.apply(image);
    const Vec3i origin = replica_.grid().brick_coordinates(image.brick) * voxel::brick_edge;
    surface::for_each_block(layout_,
                            surface::blocks_touched(layout_, origin + box.low, origin + box.high, 1),
                            [this](uint32_t block) {
                              if (std::exchange(is_touched_[block], uint8_t{1}) == 0)
                                to_extract_.push_back(block);
                            });
  }
  waiting_.clear();
}

void MeshPublisher::extract(size_t most_surfaces) {
  for (size_t surfaces = 0; next_ < to_extract_.size() && surfaces < most_surfaces; ++next_) {
    const uint32_t block = to_extract_[next_];
    is_touched_[block] = 0;
    const surface::BlockMesh mesh = extractor_.extract(replica_.coverage().data(), block);
    const uint64_t hash = surface_hash(mesh);
    surfaces += hash != 0;
    if (hash == std::exchange(shown_[block], hash)) continue;
    ready_.push_back(std::make_shared<const EncodedBlock>(encode(mesh, ++revision_[block], tick_)));
  }
}

size_t MeshPublisher::publish_ready() {
  for (SharedBlock& block : ready_) fanout_.publish_block(std::move(block));
  const size_t published = ready_.size();
  ready_.clear();
  to_extract_.clear();
  next_ = 0;
  return published;
}

}  // namespace ream::stream
