#include "surface/brick_fill.hpp"

#include "core/vector_clones.hpp"

namespace ream::surface {

REAM_VECTOR_CLONES Fill fill_of(const uint8_t* brick) {
  uint8_t any = 0, all = 0xff;
  for (int i = 0; i < voxel::brick_voxels; ++i) {
    any |= brick[i];
    all &= brick[i];
  }
  return (any & 0x80) == 0 ? Fill::none : (all & 0x80) != 0 ? Fill::all : Fill::some;
}

}  // namespace ream::surface
