#include "collide/contact_blocks.hpp"

namespace ream::collide {
namespace {

class NarrowPhaseCpu final : public NarrowPhase {
 public:
  NarrowPhaseCpu(const NarrowPhaseInput& input, Instructions instructions)
      : in_(input),
        add_block_(instructions == Instructions::best && add_block_avx512() != nullptr ? add_block_avx512()
                                                                                       : add_block_portable),
        survivors_(input.shell.blocks.size()) {
    const Vec3i dims = in_.bone.grid.dims, bricks = in_.bone.grid.brick_dims();
    view_ = {in_.shell.places.data(),
             in_.shell.directions.data(),
             in_.shell.blocks.data(),
             &in_.shell.table,
             in_.cells.words().data(),
             in_.bone.coverage.data(),
             in_.bone.density.data(),
             {dims.x(), dims.y(), dims.z()},
             bricks.x(),
             bricks.x() * bricks.y(),
             voxel::first_cortical_code(in_.bone.cortical_threshold_g_cc),
             {},
             0};
  }

  bool contact(const QuantisedPose& grid_from_tool, const Voi& voi, ContactSums& sums) noexcept override {
    sums = {};
    if (!voi.touching) return true;
    const VoxelTransform transform = voxel_transform(grid_from_tool, in_.bone.grid, in_.shell.place_unit_mm);
    const size_t n = cull_blocks(in_, voi, grid_from_tool, transform, survivors_);
    view_.per_unit = transform.per_unit;
    view_.bits = transform.bits;
    for (size_t i = 0; i < n; ++i) add_block_(view_, survivors_[i], sums);
    return true;
  }

 private:
  NarrowPhaseInput in_;
  AddBlock add_block_;
  ContactView view_;
  std::vector<SurvivingBlock> survivors_;
};

}  // namespace

std::unique_ptr<NarrowPhase> make_narrow_phase_cpu(const NarrowPhaseInput& input, Instructions instructions) {
  return std::make_unique<NarrowPhaseCpu>(input, instructions);
}

}  // namespace ream::collide
