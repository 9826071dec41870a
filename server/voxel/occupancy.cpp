#include "voxel/occupancy.hpp"

#include <algorithm>

namespace ream::voxel {

Occupancy occupancy(const BoneModel& bone) {
  Occupancy out;
  out.dims = bone.grid.dims / occupancy_edge;
  const auto cells = static_cast<size_t>(out.dims.x()) * static_cast<size_t>(out.dims.y()) *
                     static_cast<size_t>(out.dims.z());
  out.words.assign((cells + 31) / 32, 0);
  for (int w = 0; w < bone.grid.dims.z(); ++w)
    for (int v = 0; v < bone.grid.dims.y(); ++v) {
      const size_t base = static_cast<size_t>(out.dims.x()) *
                          (static_cast<size_t>(v / occupancy_edge) +
                           static_cast<size_t>(out.dims.y()) * static_cast<size_t>(w / occupancy_edge));
      for (int x = 0; x < out.dims.x(); ++x) {
        const uint8_t* row = bone.coverage.data() + bone.grid.index(x * occupancy_edge, v, w);
        if ((row[0] | row[1] | row[2] | row[3]) == 0) continue;
        const size_t cell = base + static_cast<size_t>(x);
        out.words[cell / 32] |= 1u << (cell % 32);
      }
    }
  return out;
}

}  // namespace ream::voxel
