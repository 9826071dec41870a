#include "collide/removal/removal_cl.hpp"

#include <algorithm>
#include <cstring>

#include "core/error.hpp"
#include "gpu/program.hpp"
#include "kernels/layout.h"
#include "voxel/bricks.hpp"

namespace ream::collide {
namespace {

static_assert(sizeof(layout::RemovalRecord) == 32);

layout::RemovalArguments constant_arguments(const ProfileTable& table, const voxel::VoxelGrid& grid,
                                            uint32_t slot_bytes) {
  layout::RemovalArguments a{};
  a.brick_dims_x = grid.brick_dims().x();
  a.brick_dims_y = grid.brick_dims().y();
  a.slot_bytes = slot_bytes;
  a.r2_count = table.r2_count;
  a.z_min_mm = table.z_min_mm;
  a.inverse_z_step = table.inverse_z_step;
  a.inverse_r2_step = table.inverse_r2_step;
  a.r2_limit = table.r2_limit;
  a.z_limit = table.z_limit;
  a.levels_per_step = table.levels_per_step;
  return a;
}

/// A device that shares the host's memory may leave bricks half cut when it fails; guarded() is for that.
class RemovalCl final : public Removal {
 public:
  RemovalCl(const RemovalInput& input, std::shared_ptr<BoneBuffers> bone, LaunchShape shape)
      : bone_(std::move(bone)),
        shape_(shape),
        slot_bytes_(sizeof(layout::RemovalRecord) + (bone_->shared() ? 0 : voxel::brick_voxels)),
        program_(bone_->queue, "removal.cl",
                 "-D LANES=" + std::to_string(shape.lanes) + bone_->parts.build_options()),
        kernel_(program_, "cut_bricks"),
        table_(profile_table(input.profile, coverage_levels_per_mm(input.bone.grid))),
        list_(max_bricks_per_cut),
        slots_(max_bricks_per_cut * slot_bytes_),
        table_buffer_(gpu::Buffer::copy_of(bone_->queue, std::span(table_.pairs))),
        list_buffer_(gpu::Buffer::over(bone_->queue, std::span(list_))),
        slots_buffer_(gpu::Buffer::over(bone_->queue, std::span(slots_))),
        arguments_(constant_arguments(table_, input.bone.grid, static_cast<uint32_t>(slot_bytes_))) {
    kernel_.set_all(bone_->classes, table_buffer_, list_buffer_, arguments_, slots_buffer_, bone_->coverage,
                    bone_->density);
    launch({});
    bone_->queue.finish();
  }

  bool cut(const QuantisedPose& grid_from_tool, std::span<const uint32_t> bricks,
           std::span<BrickOutcome> outcomes, RemovalSums& sums) noexcept override {
    sums = {};
    const GridAffine affine = tool_from_voxel(grid_from_tool, bone_->bone.grid);
    std::memcpy(&arguments_.tool_from_voxel, &affine, sizeof affine);
    try {
      launch(bricks);
    } catch (const Error&) {
      return false;
    }
    for (size_t i = 0; i < bricks.size(); ++i) outcomes[i] = take_slot(bricks[i], i, sums);
    return true;
  }

 private:
  void launch(std::span<const uint32_t> bricks) {
    const gpu::Queue& queue = bone_->queue;
    std::copy(bricks.begin(), bricks.end(), list_.begin());
    arguments_.bricks = static_cast<uint32_t>(bricks.size());
    kernel_.set(arguments_index, arguments_);
    if (!list_buffer_.shared()) list_buffer_.write(queue, list_.data(), bricks.size_bytes());
    kernel_.enqueue(queue, static_cast<size_t>(shape_.groups * shape_.lanes),
                    static_cast<size_t>(shape_.lanes));
    if (slots_buffer_.shared())
      queue.finish();
    else
      slots_buffer_.read(queue, slots_.data(), bricks.size() * slot_bytes_);
  }

  BrickOutcome take_slot(uint32_t brick, size_t slot, RemovalSums& sums) noexcept {
    const uint8_t* bytes = slots_.data() + slot * slot_bytes_;
    layout::RemovalRecord record;
    std::memcpy(&record, bytes, sizeof record);
    const bool changed = record.changed != 0;
    sums.changed_bricks += changed;
    sums.change_hash += record.hash_low | static_cast<uint64_t>(record.hash_high) << 32;
    for (size_t c = 0; c < voxel::bone_class_count; ++c) sums.coverage_removed[c] += record.removed[c];
    voxel::BoneModel& bone = bone_->bone;
    if (changed && !bone_->shared())
      voxel::write_brick(bone.grid, bone.coverage.data(), brick, bytes + sizeof record);
    return {changed, record.slack_levels == untouched_levels, record.slack_levels};
  }

  static constexpr unsigned arguments_index = 3;

  std::shared_ptr<BoneBuffers> bone_;
  LaunchShape shape_;
  size_t slot_bytes_;
  gpu::Program program_;
  gpu::Kernel kernel_;
  ProfileTable table_;
  std::vector<uint32_t> list_;
  std::vector<uint8_t> slots_;
  gpu::Buffer table_buffer_, list_buffer_, slots_buffer_;
  layout::RemovalArguments arguments_;
};

class GuardedRemoval final : public Removal {
 public:
  GuardedRemoval(std::unique_ptr<Removal> inner, voxel::BoneModel& bone)
      : inner_(std::move(inner)), bone_(bone), before_(max_bricks_per_cut * voxel::brick_voxels) {}

  bool cut(const QuantisedPose& grid_from_tool, std::span<const uint32_t> bricks,
           std::span<BrickOutcome> outcomes, RemovalSums& sums) noexcept override {
    for (size_t i = 0; i < bricks.size(); ++i)
      voxel::read_brick(bone_.grid, bone_.coverage.data(), bricks[i], image(i));
    if (inner_->cut(grid_from_tool, bricks, outcomes, sums)) return true;
    for (size_t i = 0; i < bricks.size(); ++i)
      voxel::write_brick(bone_.grid, bone_.coverage.data(), bricks[i], image(i));
    return false;
  }

 private:
  uint8_t* image(size_t i) noexcept { return before_.data() + i * voxel::brick_voxels; }

  std::unique_ptr<Removal> inner_;
  voxel::BoneModel& bone_;
  std::vector<uint8_t> before_;
};

}  // namespace

std::unique_ptr<Removal> make_removal_cl(const RemovalInput& input, std::shared_ptr<BoneBuffers> bone,
                                         LaunchShape shape) {
  return guarded(std::make_unique<RemovalCl>(input, std::move(bone), shape), input.bone);
}

std::unique_ptr<Removal> guarded(std::unique_ptr<Removal> inner, voxel::BoneModel& bone) {
  return std::make_unique<GuardedRemoval>(std::move(inner), bone);
}

}  // namespace ream::collide
