#pragma once
#include "gpu/queue.hpp"
#include "shell/surface_voxelizer.hpp"

namespace ream::shell {

/// As voxelize_surface_cpu, on an OpenCL device, one work-item a triangle (thesis algorithm 3.1): the same bits.
/// Throws Error unavailable when the device fails or the grid's bits do not fit in one of its buffers.
void voxelize_surface_cl(const gpu::Queue& queue, const TriangleMesh& mesh, Separability separability,
                         SurfaceVoxels& grid);

}  // namespace ream::shell
