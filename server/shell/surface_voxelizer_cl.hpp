#pragma once
#include "gpu/program.hpp"
#include "shell/surface_voxelizer.hpp"

namespace ream::shell {

/// voxelize_surface_cpu on an OpenCL device, one work-item a triangle (thesis algorithm 3.1): the same bits.
/// The queue must outlive it.
class SurfaceVoxelizerCl {
 public:
  /// Builds and warms the kernel. Throws Error unavailable.
  explicit SurfaceVoxelizerCl(const gpu::Queue& queue);

  /// Throws Error unavailable when the device fails or the grid's bits do not fit in one of its buffers.
  void voxelize(const TriangleMesh& mesh, Separability separability, SurfaceVoxels& grid);

 private:
  const gpu::Queue& queue_;
  gpu::Program program_;
  gpu::Kernel kernel_;
};

}  // namespace ream::shell
