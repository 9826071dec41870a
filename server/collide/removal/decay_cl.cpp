#include "collide/removal/removal_cl.hpp"

#include <algorithm>
#include <cstring>

#include "core/error.hpp"
#include "gpu/program.hpp"
#include "kernels/layout.h"
#include "voxel/bricks.hpp"

namespace ream::collide {
namespace {

static_assert(REAM_DECAY_RUN_POINTS == decay_run_points);

constexpr size_t max_put = REAM_DECAY_PUT_BRICKS, put_rows = max_put * 64, put_lanes = 64;

gpu::Buffer run_table(const gpu::Queue& queue, const DecayShell& shell) {
  std::vector<layout::DecayRunLayout> table;
  for (const DecayRun& run : shell.runs) table.push_back({run.first, run.count});
  return gpu::Buffer::copy_of(queue, std::span<const layout::DecayRunLayout>(table));
}

class DecayCl final : public Decay {
 public:
  DecayCl(const DecayInput& input, std::shared_ptr<BoneBuffers> bone, LaunchShape shape)
      : Decay(input),
        bone_(std::move(bone)),
        shape_(shape),
        program_(bone_->queue, "decay.cl",
                 "-D LANES=" + std::to_string(shape.lanes) + bone_->parts.build_options()),
        find_(program_, "find_hits"),
        put_(program_, "put_bricks"),
        listed_(std::max<size_t>(input.shell.runs.size(), 1)),
        hits_(listed_.size() * decay_run_points),
        put_images_(max_put * voxel::brick_voxels),
        x_(gpu::Buffer::copy_of(bone_->queue, std::span(input.shell.x_mm))),
        y_(gpu::Buffer::copy_of(bone_->queue, std::span(input.shell.y_mm))),
        z_(gpu::Buffer::copy_of(bone_->queue, std::span(input.shell.z_mm))),
        runs_(run_table(bone_->queue, input.shell)),
        listed_buffer_(gpu::Buffer::over(bone_->queue, std::span(listed_))),
        hits_buffer_(gpu::Buffer::over(bone_->queue, std::span(hits_))),
        put_list_buffer_(bone_->queue, max_put * sizeof(uint32_t)),
        put_images_buffer_(bone_->queue, put_images_.size()) {
    static_assert(no_voxel == REAM_NO_VOXEL);
    arguments_.dims_x = input.bone.grid.dims.x();
    arguments_.dims_y = input.bone.grid.dims.y();
    arguments_.dims_z = input.bone.grid.dims.z();
    find_.set_all(x_, y_, z_, runs_, listed_buffer_, arguments_, hits_buffer_, bone_->coverage);
    put_.set_all(put_list_buffer_, put_images_buffer_, uint32_t{0}, bone_->coverage);
    launch(0);
    put_.enqueue(bone_->queue, put_rows, put_lanes);
    bone_->queue.finish();
  }

  bool publish() noexcept override {
    if (bone_->shared()) return true;
    const std::span<const uint32_t> bricks = changed_bricks();
    try {
      for (size_t done = 0; done < bricks.size(); done += max_put)
        put(bricks.subspan(done, std::min(max_put, bricks.size() - done)));
      return true;
    } catch (const Error&) {
      return false;
    }
  }

 private:
  Hits find_hits(const GridAffine& voxel_from_tool, std::span<const uint32_t> runs) noexcept override {
    if (runs.empty()) return {};
    std::memcpy(&arguments_.voxel_from_tool, &voxel_from_tool, sizeof voxel_from_tool);
    std::copy(runs.begin(), runs.end(), listed_.begin());
    try {
      launch(runs.size());
      return {{hits_.data(), runs.size() * decay_run_points}, true};
    } catch (const Error&) {
      return {{}, false};
    }
  }

  void launch(size_t runs) {
    const gpu::Queue& queue = bone_->queue;
    arguments_.listed = static_cast<uint32_t>(runs);
    find_.set(arguments_index, arguments_);
    if (!listed_buffer_.shared()) listed_buffer_.write(queue, listed_.data(), runs * sizeof(uint32_t));
    find_.enqueue(queue, static_cast<size_t>(shape_.groups * shape_.lanes),
                  static_cast<size_t>(shape_.lanes));
    if (hits_buffer_.shared())
      queue.finish();
    else
      hits_buffer_.read(queue, hits_.data(), runs * decay_run_points * sizeof(uint32_t));
  }

  void put(std::span<const uint32_t> bricks) {
    const gpu::Queue& queue = bone_->queue;
    for (size_t i = 0; i < bricks.size(); ++i)
      voxel::read_brick(in_.bone.grid, in_.bone.coverage.data(), bricks[i],
                        put_images_.data() + i * voxel::brick_voxels);
    put_list_buffer_.write(queue, bricks.data(), bricks.size_bytes());
    put_images_buffer_.write(queue, put_images_.data(), bricks.size() * voxel::brick_voxels);
    put_.set(2, static_cast<uint32_t>(bricks.size()));
    put_.enqueue(queue, put_rows, put_lanes);
  }

  static constexpr unsigned arguments_index = 5;

  std::shared_ptr<BoneBuffers> bone_;
  LaunchShape shape_;
  gpu::Program program_;
  gpu::Kernel find_, put_;
  std::vector<uint32_t> listed_, hits_;
  std::vector<uint8_t> put_images_;
  gpu::Buffer x_, y_, z_, runs_, listed_buffer_, hits_buffer_, put_list_buffer_, put_images_buffer_;
  layout::DecayArguments arguments_{};
};

}  // namespace

std::unique_ptr<Decay> make_decay_cl(const DecayInput& input, std::shared_ptr<BoneBuffers> bone,
                                     LaunchShape shape) {
  return std::make_unique<DecayCl>(input, std::move(bone), shape);
}

}  // namespace ream::collide
