#pragma once
#include "bench/femesh/foam.hpp"

namespace ream::bench {

/// What our compute phases take, ms, reading and writing of files apart. `nodes` and `connectivity` in the
/// sense of the thesis: every coordinate and all eight ids of every element are computed and stored.
struct OurMesh {
  double grid_ms = 0.0, components_ms = 0.0, upsample_ms = 0.0, materials_ms = 0.0, sets_ms = 0.0,
         numbering_ms = 0.0, explicit_ms = 0.0;
  uint64_t elements = 0, nodes = 0, materials = 0, islands = 0;

  double sum_ms() const {
    return grid_ms + components_ms + upsample_ms + materials_ms + sets_ms + numbering_ms + explicit_ms;
  }
};

/// From gray values of the whole grid in memory; E = gray in bins of `bin_width` (0: none).
OurMesh our_mesh(const Foam& foam, int upsample, double bin_width);

/// Unique nodes of a foam by numbering alone, and how long it took, ms.
OurMesh our_numbering(const Foam& foam);

}  // namespace ream::bench
