#include "stream/mesh_publisher.hpp"

#include <algorithm>
#include <bit>
#include <climits>
#include <cstring>
#include <utility>

#include "core/hash.hpp"
#include "core/vector_clones.hpp"

namespace ream::stream {
namespace {

REAM_VECTOR_CLONES int max_difference(const uint8_t* a, const uint8_t* b) {
  uint8_t largest = 0;
  for (int i = 0; i < voxel::brick_voxels; ++i) {
    const auto difference = static_cast<uint8_t>(std::max(a[i], b[i]) - std::min(a[i], b[i]));
    largest = std::max(largest, difference);
  }
  return largest;
}

/// Of the mesh and of what is gone at its vertices. Not 0 unless the mesh is empty.
uint64_t surface_hash(const surface::BlockMesh& mesh, const std::vector<uint8_t>& removed) {
  uint64_t hash = mesh.indices.size();
  for (const uint8_t level : removed) hash = hash * 0x9e3779b97f4a7c15ull + level;
  for (const surface::BlockVertex& v : mesh.vertices) {
    uint64_t word;
    std::memcpy(&word, &v, sizeof word);
    hash = mix64(hash ^ word);
  }
  for (const uint32_t index : mesh.indices) hash = hash * 0x9e3779b97f4a7c15ull + index;
  return mesh.indices.empty() ? 0 : std::max<uint64_t>(hash, 1);
}

}  // namespace

VoxelBox difference_box(const uint8_t* a, const uint8_t* b) {
  constexpr int edge = voxel::brick_edge;
  VoxelBox box{Vec3i::Constant(edge), Vec3i::Constant(-1)};
  uint64_t columns = 0;  // byte x is not 0 where any row differs at x
  for (int z = 0; z < edge; ++z)
    for (int y = 0; y < edge; ++y, a += edge, b += edge) {
      uint64_t row_a, row_b;
      std::memcpy(&row_a, a, edge);
      std::memcpy(&row_b, b, edge);
      if (row_a == row_b) continue;
      columns |= row_a ^ row_b;
      box.low = box.low.cwiseMin(Vec3i(edge, y, z));
      box.high = box.high.cwiseMax(Vec3i(-1, y, z));
    }
  box.low.x() = std::countr_zero(columns) / 8;
  box.high.x() = edge - 1 - std::countl_zero(columns) / 8;
  return box;
}

void WaitingBricks::put(const voxel::BrickImage& image, const uint8_t* shown, int64_t now_ns) {
  const int moved = max_difference(shown, image.coverage);
  const auto known = place_.find(image.brick);
  if (known == place_.end()) {
    if (moved == 0) return;
    if (images_.empty()) since_ns_ = now_ns;
    place_.emplace(image.brick, images_.size());
    images_.push_back(image);
  } else {
    images_[known->second] = image;
  }
  max_moved_ = std::max(max_moved_, moved);
  newest_tick_ = std::max(newest_tick_, image.tick);
}

void WaitingBricks::clear() {
  images_.clear();
  place_.clear();
  max_moved_ = 0;
  newest_tick_ = 0;
}

MeshPublisher::Level::Level(const voxel::VoxelGrid& grid, int stride_voxels)
    : stride(stride_voxels),
      extractor(grid, stride),
      revision(extractor.layout().count()),
      shown(extractor.layout().count()),
      is_touched(extractor.layout().count()) {}

void MeshPublisher::Level::touch(uint32_t block) {
  if (std::exchange(is_touched[block], uint8_t{1}) == 0) to_extract.push_back(block);
}

MeshPublisher::MeshPublisher(const voxel::BoneModel& bone, Fanout& fanout, MeshPublisherOptions options,
                             const std::vector<uint8_t>* before)
    : replica_(bone),
      classes_(bone),
      removed_(replica_),
      fanout_(fanout),
      options_(options),
      layout_(bone.grid) {
  for (const int stride : {1, 2, 4}) levels_.emplace_back(bone.grid, stride);
  if (before != nullptr) keep_changed(*before);
}

void MeshPublisher::keep_changed(const std::vector<uint8_t>& before) {
  for (size_t first = 0; first < before.size(); first += voxel::brick_voxels) {
    const auto brick = static_cast<uint32_t>(first / voxel::brick_voxels);
    if (std::memcmp(before.data() + first, replica_.brick(brick), voxel::brick_voxels) != 0)
      removed_.keep(brick, before.data() + first);
  }
}

void MeshPublisher::take(const voxel::BrickImage& image, int64_t now_ns) {
  waiting_.put(image, replica_.brick(image.brick), now_ns);
}

void MeshPublisher::publish_all() {
  Level& full = levels_.front();
  for (uint32_t block = 0; block < layout_.count(); ++block) full.touch(block);
  full.picture = Level::Picture::begun;
  extract(INT_MAX);
  publish_ready();
}

size_t MeshPublisher::poll(int64_t now_ns) {
  if (now_ns - last_work_ns_ < options_.min_interval_ns) return 0;
  if (!extracting()) {
    begin_pictures();
    if (due(now_ns)) begin_update();
    if (!extracting()) return 0;
  }
  last_work_ns_ = now_ns;
  extract(options_.max_surfaces);
  return extracting() ? 0 : publish_ready();
}

size_t MeshPublisher::flush(int64_t now_ns) {
  extract(INT_MAX);
  size_t published = publish_ready();
  begin_pictures();
  begin_update();
  extract(INT_MAX);
  published += publish_ready();
  last_work_ns_ = now_ns;
  return published;
}

bool MeshPublisher::due(int64_t now_ns) const {
  return !waiting_.empty() && (waiting_.max_moved() >= options_.noticeable_coverage ||
                               now_ns - waiting_.since_ns() >= options_.max_delay_ns);
}

bool MeshPublisher::extracting() const {
  return std::any_of(levels_.begin(), levels_.end(),
                     [](const Level& level) { return level.next < level.to_extract.size(); });
}

void MeshPublisher::begin_pictures() {
  for (Level& level : levels_) {
    if (level.picture != Level::Picture::unwanted || !fanout_.wants(level.stride)) continue;
    level.picture = Level::Picture::begun;
    for (uint32_t block = 0; block < layout_.count(); ++block) level.touch(block);
  }
}

void MeshPublisher::begin_update() {
  if (!waiting_.empty()) tick_ = waiting_.newest_tick();
  for (const voxel::BrickImage& image : waiting_.images()) {
    const uint8_t* shown = replica_.brick(image.brick);
    if (std::memcmp(shown, image.coverage, voxel::brick_voxels) == 0) continue;
    const VoxelBox box = difference_box(shown, image.coverage);
    removed_.keep(image.brick, shown);
    replica_.apply(image);
    const Vec3i origin = replica_.grid().brick_coordinates(image.brick) * voxel::brick_edge;
    for (Level& level : levels_) {
      if (level.picture == Level::Picture::unwanted) continue;
      const auto range = surface::blocks_touched(layout_, origin + box.low, origin + box.high, level.stride);
      surface::for_each_block(layout_, range, [&level](uint32_t block) { level.touch(block); });
    }
  }
  waiting_.clear();
}

void MeshPublisher::extract(int max_surfaces) {
  constexpr int whole = 16;  // what a surface of stride 1 costs; triangles go with the stride's square
  int64_t left = int64_t{max_surfaces} * whole;
  for (Level& level : levels_)
    for (; level.next < level.to_extract.size() && left > 0; ++level.next) {
      const uint32_t block = level.to_extract[level.next];
      level.is_touched[block] = 0;
      const surface::BlockMesh mesh = level.extractor.extract(replica_.coverage().data(), block);
      const std::vector<uint8_t> removed = removed_.levels(mesh.vertices, block);
      const uint64_t hash = surface_hash(mesh, removed);
      if (hash != 0) left -= whole / (level.stride * level.stride);
      if (hash == std::exchange(level.shown[block], hash)) continue;
      ready_.push_back(
          std::make_shared<const EncodedBlock>(encode(mesh, ++level.revision[block], tick_, level.stride,
                                                      options_.with_classes ? &classes_ : nullptr, removed)));
    }
}

size_t MeshPublisher::publish_ready() {
  for (SharedBlock& block : ready_) fanout_.publish_block(std::move(block));
  const size_t published = ready_.size();
  ready_.clear();
  for (Level& level : levels_) {
    level.to_extract.clear();
    level.next = 0;
    if (level.picture != Level::Picture::begun) continue;
    level.picture = Level::Picture::complete;
    fanout_.publish_picture_complete(level.stride);
  }
  return published;
}

}  // namespace ream::stream
