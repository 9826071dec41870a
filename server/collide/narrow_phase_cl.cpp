#include "collide/narrow_phase_cl.hpp"

#include <cstring>

#include "core/error.hpp"
#include "gpu/program.hpp"
#include "kernels/layout.h"

namespace ream::collide {
namespace {

static_assert(sizeof(ContactVector) == 16);
static_assert(sizeof(layout::AffineArguments) == sizeof(GridAffine));
static_assert(REAM_ENGAGING_COVERAGE == engaging_coverage);
static_assert(REAM_OCCUPANCY_EDGE == voxel::occupancy_edge);

/// A copy with room for one chunk behind, so that the last chunk may be loaded whole.
gpu::Buffer padded_copy(const gpu::Queue& queue, std::vector<float> values) {
  values.resize(values.size() + REAM_CONTACT_CHUNK, 0.0f);
  return gpu::Buffer::copy_of(queue, std::span<const float>(values));
}

gpu::Buffer block_table(const gpu::Queue& queue, const ContactShell& shell) {
  std::vector<layout::ContactBlock> table;
  for (const auto& block : shell.blocks) table.push_back({block.first, block.count});
  return gpu::Buffer::copy_of(queue, std::span<const layout::ContactBlock>(table));
}

void add_part(const int64_t* products, int64_t points, ContactSums::Part& part) {
  part.points += points;
  for (size_t i = 0; i < 7; ++i) part.first[i] += products[6 * 8 + i];
  size_t k = 0;
  for (size_t i = 0; i < 6; ++i)
    for (size_t j = i; j < 6; ++j) part.second[k++] += products[i * 8 + j];
}

class NarrowPhaseCl final : public NarrowPhase {
 public:
  NarrowPhaseCl(const NarrowPhaseInput& input, std::shared_ptr<BoneBuffers> bone, LaunchShape shape)
      : in_(input),
        bone_(std::move(bone)),
        shape_(shape),
        program_(bone_->queue, "narrow_phase.cl", "-D LANES=" + std::to_string(shape.lanes)),
        kernel_(program_, "contact_sums"),
        survivors_(std::max<size_t>(input.shell.blocks.size(), 1)),
        partial_(static_cast<size_t>(shape.groups) * REAM_CONTACT_SUMS),
        probe_x_(padded_copy(bone_->queue, input.shell.probe_x_mm)),
        probe_y_(padded_copy(bone_->queue, input.shell.probe_y_mm)),
        probe_z_(padded_copy(bone_->queue, input.shell.probe_z_mm)),
        vectors_(gpu::Buffer::copy_of(bone_->queue, std::span(input.shell.vectors))),
        weights_(gpu::Buffer::copy_of(bone_->queue, std::span(input.shell.weights))),
        guiding_(gpu::Buffer::copy_of(bone_->queue, std::span(input.shell.guiding))),
        blocks_(block_table(bone_->queue, input.shell)),
        occupancy_(gpu::Buffer::copy_of(bone_->queue, std::span(input.occupancy.words))),
        survivor_buffer_(gpu::Buffer::over(bone_->queue, std::span(survivors_))),
        partial_buffer_(gpu::Buffer::over(bone_->queue, std::span(partial_))) {
    kernel_.set_all(probe_x_, probe_y_, probe_z_, vectors_, weights_, guiding_, blocks_, survivor_buffer_,
                    occupancy_, bone_->coverage, bone_->density, bone_->classes, layout::ContactArguments{},
                    partial_buffer_);
    ContactSums warm;
    run(GridAffine{}, 0, warm);
    bone_->queue.finish();
  }

  bool contact(const QuantisedPose& grid_from_tool, const Voi& voi, ContactSums& sums) noexcept override {
    sums = {};
    if (!voi.touching) return true;
    const GridAffine affine = voxel_from_tool(grid_from_tool, in_.bone.grid);
    const size_t count = cull_blocks(in_.shell, in_.distance, voi, affine,
                                     static_cast<float>(in_.bone.grid.min_spacing_mm()), survivors_);
    if (count == 0) return true;
    try {
      run(affine, count, sums);
      return true;
    } catch (const Error&) {
      return false;
    }
  }

 private:
  void run(const GridAffine& affine, size_t survivors, ContactSums& sums) {
    const gpu::Queue& queue = bone_->queue;
    const Vec3i& dims = in_.bone.grid.dims;
    layout::ContactArguments arguments{{}, dims.x(), dims.y(), dims.z(), static_cast<uint32_t>(survivors)};
    std::memcpy(&arguments.voxel_from_tool, &affine, sizeof affine);
    kernel_.set(arguments_index, arguments);
    if (!survivor_buffer_.shared())
      survivor_buffer_.write(queue, survivors_.data(), survivors * sizeof(uint32_t));
    kernel_.enqueue(queue, static_cast<size_t>(shape_.groups * shape_.lanes),
                    static_cast<size_t>(shape_.lanes));
    if (partial_buffer_.shared())
      queue.finish();
    else
      partial_buffer_.read(queue, partial_.data(), partial_buffer_.bytes());
    for (size_t g = 0; g < static_cast<size_t>(shape_.groups); ++g)
      add_group(&partial_[g * REAM_CONTACT_SUMS], sums);
  }

  static void add_group(const int64_t* group, ContactSums& sums) {
    add_part(group + REAM_CONTACT_CUTTING, group[REAM_CONTACT_CUTTING_POINTS], sums.cutting);
    add_part(group + REAM_CONTACT_GUIDING, group[REAM_CONTACT_GUIDING_POINTS], sums.guiding);
    for (size_t c = 0; c < voxel::bone_class_count; ++c) {
      sums.class_points[c] += group[REAM_CONTACT_CLASS_POINTS + c];
      sums.class_density[c] += group[REAM_CONTACT_CLASS_DENSITY + c];
    }
  }

  static constexpr unsigned arguments_index = 12;

  NarrowPhaseInput in_;
  std::shared_ptr<BoneBuffers> bone_;
  LaunchShape shape_;
  gpu::Program program_;
  gpu::Kernel kernel_;
  std::vector<uint32_t> survivors_;
  std::vector<int64_t> partial_;
  gpu::Buffer probe_x_, probe_y_, probe_z_, vectors_, weights_, guiding_, blocks_, occupancy_,
      survivor_buffer_, partial_buffer_;
};

}  // namespace

std::unique_ptr<NarrowPhase> make_narrow_phase_cl(const NarrowPhaseInput& input,
                                                  std::shared_ptr<BoneBuffers> bone, LaunchShape shape) {
  return std::make_unique<NarrowPhaseCl>(input, std::move(bone), shape);
}

}  // namespace ream::collide
