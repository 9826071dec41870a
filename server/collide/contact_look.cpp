#include "collide/contact_look.hpp"

namespace ream::collide {

ContactView contact_view(const NarrowPhaseInput& input) noexcept {
  const Vec3i dims = input.bone.grid.dims, bricks = input.bone.grid.brick_dims();
  return {input.shell.places.data(),
          input.shell.directions.data(),
          input.shell.blocks.data(),
          &input.shell.table,
          input.cells.words().data(),
          input.bone.coverage.data(),
          input.bone.density.data(),
          {dims.x(), dims.y(), dims.z()},
          bricks.x(),
          bricks.x() * bricks.y(),
          voxel::first_cortical_code(input.bone.cortical_threshold_g_cc),
          {},
          0};
}

DueChunk shifted(const ContactView& view, const DueChunk& chunk, Clearance clearance, int corner) noexcept {
  const auto reach = static_cast<int32_t>(clearance_voxels(clearance) * static_cast<float>(1 << view.bits));
  DueChunk moved = chunk;
  for (size_t i = 0; i < 3; ++i) moved.base[i] += corner >> i & 1 ? reach : -reach;
  return moved;
}

LookFunctions best_look() noexcept {
  const LookFunctions best = avx512_look();
  return best.look != nullptr ? best : portable_look();
}

}  // namespace ream::collide
