#include "collide/contact/narrow_phase_cl.hpp"

#include <algorithm>

#include "collide/contact/contact_schedule.hpp"
#include "collide/contact/surface_judge.hpp"
#include "core/error.hpp"
#include "gpu/program.hpp"
#include "kernels/layout.h"

namespace ream::collide {
namespace {

static_assert(REAM_CONTACT_PRODUCTS == std::tuple_size_v<ContactProducts>);
static_assert(REAM_PLACE_BITS == place_bits && REAM_AZIMUTH_BITS == azimuth_bits);
static_assert(REAM_AZIMUTH_SHIFT == azimuth_shift);
static_assert(REAM_CARTILAGE_CODE == voxel::cartilage_code && REAM_JUDGE_TOLERANCE == judge_tolerance_levels);
static_assert(REAM_JUDGE_FRACTION_BITS == judge_fraction_bits &&
              REAM_JUDGE_ROTATION_BITS == judge_rotation_bits);
static_assert(sizeof(DueChunk) == sizeof(layout::DueChunkLayout));
static_assert(REAM_CONTACT_CHUNK == chunk_points && REAM_CONTACT_BLOCK_CHUNKS == max_block_chunks);

gpu::Buffer block_table(const gpu::Queue& queue, const ContactShell& shell) {
  std::vector<layout::ContactBlockLayout> table;
  table.reserve(shell.blocks.size());
  for (const ContactBlock& block : shell.blocks) {
    {
      layout::ContactBlockLayout entry{
          block.guiding, block.count, block.origin_units.z(), block.height_units, {}};
      std::copy(block.whole.begin(), block.whole.end(), entry.whole);
      table.push_back(entry);
    }
  }
  return gpu::Buffer::copy_of(queue, std::span<const layout::ContactBlockLayout>(table));
}

layout::ContactArguments constant_arguments(const voxel::BoneModel& bone) {
  const Vec3i dims = bone.grid.dims, bricks = bone.grid.brick_dims();
  layout::ContactArguments a{};
  for (int i = 0; i < 3; ++i) a.dims[i] = dims[i];
  a.brick_row = bricks.x();
  a.brick_slice = bricks.x() * bricks.y();
  a.first_cortical_code = voxel::first_cortical_code(bone.cortical_threshold_g_cc);
  return a;
}

class NarrowPhaseCl final : public NarrowPhase {
 public:
  NarrowPhaseCl(const NarrowPhaseInput& input, std::shared_ptr<BoneBuffers> bone, LaunchShape shape)
      : in_(input),
        bone_(std::move(bone)),
        shape_(shape),
        program_(bone_->queue, "narrow_phase.cl",
                 "-D LANES=" + std::to_string(shape.lanes) + bone_->parts.build_options()),
        kernel_(program_, "contact_sums"),
        patch_kernel_(program_, "patch_cells"),
        due_(std::max<size_t>(input.shell.chunk_count(), 1)),
        touched_(due_.size()),
        view_(contact_view(input)),
        is_clear_(best_contact_kernels().is_clear),
        schedule_(input),
        partial_(static_cast<size_t>(shape.groups) * REAM_CONTACT_SUMS),
        patches_(max_patches),
        arguments_(constant_arguments(input.bone)),
        places_(gpu::Buffer::copy_of(bone_->queue, std::span(input.shell.places))),
        directions_(gpu::Buffer::copy_of(bone_->queue, std::span(input.shell.directions))),
        normals_(gpu::Buffer::copy_of(bone_->queue, std::span(input.shell.normals))),
        blocks_(block_table(bone_->queue, input.shell)),
        meridian_(gpu::Buffer::copy_of(bone_->queue, std::span(input.shell.table.meridian))),
        areas_(gpu::Buffer::copy_of(bone_->queue, std::span(input.shell.table.areas))),
        azimuth_(gpu::Buffer::copy_of(bone_->queue, std::span(input.shell.table.azimuth))),
        resistances_(gpu::Buffer::copy_of(bone_->queue, std::span<const uint32_t>(input.resistances))),
        cells_(gpu::Buffer::over(bone_->queue, std::span(input.cells.words()))),
        due_buffer_(gpu::Buffer::over(bone_->queue, std::span(due_))),
        partial_buffer_(gpu::Buffer::over(bone_->queue, std::span(partial_))),
        touched_buffer_(gpu::Buffer::over(bone_->queue, std::span(touched_))),
        patch_buffer_(gpu::Buffer::over(bone_->queue, std::span(patches_))) {
    kernel_.set_all(places_, directions_, normals_, blocks_, due_buffer_, meridian_, areas_, azimuth_,
                    resistances_, cells_, arguments_, partial_buffer_, touched_buffer_, bone_->coverage,
                    bone_->density);
    patch_kernel_.set_all(patch_buffer_, uint32_t{0}, cells_);
    ContactSums warm;
    patch_kernel_.enqueue(bone_->queue, max_patches, patch_lanes);
    run({}, 0, warm);
    bone_->queue.finish();
  }

  bool contact(const QuantisedPose& grid_from_tool, const Voi& voi, ContactSums& sums) noexcept override {
    sums = {};
    if (!voi.touching) return true;
    const VoxelTransform transform = voxel_transform(grid_from_tool, in_.bone.grid, in_.shell.place_unit_mm);
    view_.look_from(transform);
    const auto due = schedule_.due(grid_from_tool, voi, transform);
    if (due.empty()) return true;
    std::copy(due.begin(), due.end(), due_.begin());
    try {
      run(transform, due.size(), sums);
      schedule_.visited(view_, is_clear_, touched_);
      return true;
    } catch (const Error&) {
      return false;
    }
  }

  bool bricks_changed(std::span<const uint32_t> bricks) noexcept override {
    if (cells_.shared()) return true;
    try {
      for (size_t done = 0; done < bricks.size(); done += max_patches)
        patch(bricks.subspan(done, std::min(max_patches, bricks.size() - done)));
      return true;
    } catch (const Error&) {
      return false;
    }
  }

 private:
  void run(const VoxelTransform& transform, size_t chunks, ContactSums& sums) {
    const gpu::Queue& queue = bone_->queue;
    std::copy(transform.per_unit.begin(), transform.per_unit.end(), arguments_.per_unit);
    std::copy(transform.normal_rotation.begin(), transform.normal_rotation.end(), arguments_.normal_rotation);
    arguments_.bits = transform.bits;
    arguments_.chunks = static_cast<uint32_t>(chunks);
    kernel_.set(arguments_index, arguments_);
    if (!due_buffer_.shared()) due_buffer_.write(queue, due_.data(), chunks * sizeof(DueChunk));
    kernel_.enqueue(queue, static_cast<size_t>(shape_.groups * shape_.lanes),
                    static_cast<size_t>(shape_.lanes));
    if (partial_buffer_.shared()) {
      queue.finish();
    } else {
      partial_buffer_.read(queue, partial_.data(), partial_buffer_.bytes());
      touched_buffer_.read(queue, touched_.data(), chunks);
    }
    for (size_t g = 0; g < static_cast<size_t>(shape_.groups); ++g)
      add_group(&partial_[g * REAM_CONTACT_SUMS], sums);
  }

  void patch(std::span<const uint32_t> bricks) {
    for (size_t i = 0; i < bricks.size(); ++i) patches_[i] = {bricks[i], in_.cells.word(bricks[i])};
    if (!patch_buffer_.shared())
      patch_buffer_.write(bone_->queue, patches_.data(), bricks.size() * sizeof(layout::CellPatch));
    patch_kernel_.set(1, static_cast<uint32_t>(bricks.size()));
    patch_kernel_.enqueue(bone_->queue, max_patches, patch_lanes);
  }

  static void add_group(const int64_t* group, ContactSums& sums) {
    add_products_to(sums.cutting, std::span(group, REAM_CONTACT_PRODUCTS), group[REAM_CONTACT_PRODUCTS]);
    const int64_t* guiding = group + REAM_CONTACT_PART_SUMS;
    add_products_to(sums.guiding, std::span(guiding, REAM_CONTACT_PRODUCTS), guiding[REAM_CONTACT_PRODUCTS]);
    for (size_t c = 0; c < voxel::bone_class_count; ++c) {
      sums.class_weight[c] += group[REAM_CONTACT_CLASS_WEIGHT + c];
      sums.class_density[c] += group[REAM_CONTACT_CLASS_DENSITY + c];
    }
    sums.resistance += group[REAM_CONTACT_RESISTANCE];
    sums.deepest = std::max(sums.deepest, group[REAM_CONTACT_DEEPEST]);
  }

  static constexpr unsigned arguments_index = 10;
  static constexpr size_t max_patches = 1024, patch_lanes = 64;

  NarrowPhaseInput in_;
  std::shared_ptr<BoneBuffers> bone_;
  LaunchShape shape_;
  gpu::Program program_;
  gpu::Kernel kernel_, patch_kernel_;
  std::vector<DueChunk> due_;
  std::vector<uint8_t> touched_;  ///< per due chunk: has engaged points
  ContactView view_;              ///< the host's, for measuring what is free
  IsClear is_clear_;
  ContactSchedule schedule_;
  std::vector<int64_t> partial_;
  std::vector<layout::CellPatch> patches_;
  layout::ContactArguments arguments_;
  gpu::Buffer places_, directions_, normals_, blocks_, meridian_, areas_, azimuth_, resistances_, cells_,
      due_buffer_, partial_buffer_, touched_buffer_, patch_buffer_;
};

}  // namespace

std::unique_ptr<NarrowPhase> make_narrow_phase_cl(const NarrowPhaseInput& input,
                                                  std::shared_ptr<BoneBuffers> bone, LaunchShape shape) {
  return std::make_unique<NarrowPhaseCl>(input, std::move(bone), shape);
}

}  // namespace ream::collide
