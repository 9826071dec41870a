#include "twin/bone_twin.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <span>
#include <utility>

#include "core/hash.hpp"
#include "record/session_hash.hpp"
#include "surface/surface_parts.hpp"

namespace ream::twin {

using voxel::brick_edge;
using voxel::brick_voxels;

BoneTwin::Reaming::Reaming(shell::SweptProfile of_tool, voxel::BoneModel& bone)
    : profile(std::make_shared<const shell::SweptProfile>(std::move(of_tool))),
      removal(collide::make_removal_cpu({*profile, bone})),
      schedule(*profile, bone) {}

BoneTwin::BoneTwin(voxel::BoneModel bone)
    : bone_(std::move(bone)),
      extractor_(bone_.grid),
      removed_(bone_.grid, bone_.coverage),
      block_changed_(extractor_.layout().count(), 1),
      is_changed_(bone_.grid.brick_count()) {}

void BoneTwin::tell_density(std::vector<uint8_t> density, double cortical_threshold_g_cc) {
  assert(!reaming_ && density.size() == bone_.grid.voxel_count());
  bone_.density = std::move(density);
  bone_.cortical_threshold_g_cc = cortical_threshold_g_cc;
  classes_.emplace(bone_);
}

void BoneTwin::begin_segment(shell::SweptProfile profile) {
  reaming_ = std::make_unique<Reaming>(std::move(profile), bone_);
}

uint64_t BoneTwin::step(const CauseTick& cause) noexcept {
  assert(reaming_);
  if ((cause.flags & record::cutting_flag) != 0)
    cut(cause.grid_from_tool);
  else
    reaming_->schedule.pass(cause.grid_from_tool);
  session_hash_ = record::hash_after(session_hash_, cause.tick, cause.flags, cause.grid_from_tool);
  return session_hash_;
}

uint8_t* BoneTwin::coverage_of(uint32_t brick) noexcept {
  return bone_.coverage.data() + size_t{brick} * brick_voxels;
}

/// As sim::remove_bone folds it into the hash.
void BoneTwin::cut(const QuantisedPose& grid_from_tool) noexcept {
  collide::RemovalSums sums;
  std::array<collide::BrickOutcome, collide::RemovalSchedule::max_bricks_per_tick> outcomes;
  collide::cut_due(
      reaming_->schedule, grid_from_tool, outcomes,
      [&](std::span<const uint32_t> due) {
        for (const uint32_t brick : due) removed_.keep(brick, coverage_of(brick));
        return reaming_->removal->cut(grid_from_tool, due, outcomes, sums);
      },
      [this](uint32_t brick) { note_change(brick); });
  if (sums.changed_bricks != 0) session_hash_ = hash_combine(session_hash_, sums.change_hash);
}

void BoneTwin::note_change(uint32_t brick) noexcept {
  if (std::exchange(is_changed_[brick], uint8_t{1}) == 0) changed_.push_back(brick);
  show_change(brick);
}

void BoneTwin::show_change(uint32_t brick) noexcept {
  const Vec3i low = bone_.grid.brick_coordinates(brick) * brick_edge;
  const surface::BlockLayout& layout = extractor_.layout();
  surface::for_each_block(layout,
                          surface::blocks_touched(layout, low, (low.array() + (brick_edge - 1)).matrix(), 1),
                          [this](uint32_t block) { block_changed_[block] = 1; });
}

size_t BoneTwin::keep_snapshot() {
  if (snapshots_passed_ == snapshots_.size()) {
    Snapshot snapshot;
    snapshot.session_hash = session_hash_;
    if (reaming_) snapshot.reaming = std::make_unique<const Reaming>(*reaming_);
    snapshot.bricks = changed_;
    snapshot.coverage.reserve(changed_.size() * brick_voxels);
    for (const uint32_t brick : changed_)
      snapshot.coverage.insert(snapshot.coverage.end(), coverage_of(brick),
                               coverage_of(brick) + brick_voxels);
    snapshots_.push_back(std::move(snapshot));
  }
  for (const uint32_t brick : changed_) is_changed_[brick] = 0;
  changed_.clear();
  return snapshots_passed_++;
}

void BoneTwin::go_to(size_t to) {
  assert(to < snapshots_.size());
  std::vector<uint8_t> other(is_changed_);
  std::vector<uint32_t> bricks(std::move(changed_));
  for (size_t i = std::min(to + 1, snapshots_passed_); i < std::max(to + 1, snapshots_passed_); ++i)
    for (const uint32_t brick : snapshots_[i].bricks)
      if (std::exchange(other[brick], uint8_t{1}) == 0) bricks.push_back(brick);
  for (const uint32_t brick : bricks) {
    std::memcpy(coverage_of(brick), removed_.kept(brick), brick_voxels);
    show_change(brick);
  }
  for (size_t i = 0; i <= to; ++i)
    for (size_t place = 0; place < snapshots_[i].bricks.size(); ++place)
      if (const uint32_t brick = snapshots_[i].bricks[place]; other[brick] != 0)
        std::memcpy(coverage_of(brick), snapshots_[i].coverage.data() + place * brick_voxels, brick_voxels);
  const Snapshot& snapshot = snapshots_[to];
  session_hash_ = snapshot.session_hash;
  reaming_ = snapshot.reaming ? std::make_unique<Reaming>(*snapshot.reaming) : nullptr;
  changed_.clear();
  is_changed_.assign(is_changed_.size(), 0);
  snapshots_passed_ = to + 1;
}

std::vector<uint32_t> BoneTwin::take_changed_blocks() {
  std::vector<uint32_t> blocks;
  for (uint32_t block = 0; block < block_changed_.size(); ++block)
    if (std::exchange(block_changed_[block], uint8_t{0}) != 0) blocks.push_back(block);
  return blocks;
}

TriangleMesh BoneTwin::whole_surface() {
  std::vector<surface::SurfacePart> parts(block_count());
  for (uint32_t block = 0; block < parts.size(); ++block) {
    parts[block].mesh = extractor_.extract(bone_.coverage.data(), block);
    surface::count_owned(parts[block], 1);
  }
  TriangleMesh whole = surface::lay_out(parts);
  for (const surface::SurfacePart& part : parts)
    surface::join(extractor_.layout(), bone_.grid.spacing_mm, 1, parts, part, whole);
  return whole;
}

MarkedSurface BoneTwin::surface_of(uint32_t block) {
  MarkedSurface surface;
  surface.mesh = extractor_.extract(bone_.coverage.data(), block);
  const auto& vertices = surface.mesh.vertices;
  const std::vector<uint8_t> levels = removed_.levels(vertices, block);
  std::vector<uint8_t> codes;
  if (classes_) codes = classes_->codes(vertices, block, 1);
  if (!codes.empty()) surface.classes = classes_->packed_classes(codes);
  if (!levels.empty()) {
    surface.removed = stream::RemovedBone::packed(levels);
    surface.densities = stream::SurfaceClasses::packed_densities(codes);
  }
  return surface;
}

}  // namespace ream::twin
