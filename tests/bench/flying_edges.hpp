#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace ream::bench {

struct FlyingEdgesRun {
  double ms = 0.0;
  size_t triangles = 0;
};

/// vtkFlyingEdges3D at 127.5 over coverage in row order (x fastest) with that many threads; nothing where
/// this build has no VTK (Debian: libvtk9-dev). The copy into VTK's own image is not timed.
std::optional<FlyingEdgesRun> run_flying_edges(const std::array<int, 3>& dims,
                                               std::vector<uint8_t>& coverage_rows, bool normals,
                                               int threads);

}  // namespace ream::bench
