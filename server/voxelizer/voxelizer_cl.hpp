#pragma once
#include "gpu/program.hpp"
#include "voxelizer/voxelizer.hpp"

namespace ream::voxelizer {

/// Voxelizer on an OpenCL device, which must know doubles: the same bits. The queue must outlive it.
class VoxelizerCl {
 public:
  /// Builds and warms the kernels. Throws Error unavailable, also for a device without doubles.
  explicit VoxelizerCl(const gpu::Queue& queue);

  /// As Voxelizer::voxelize. A grid that does not fit in one of the device's buffers is done part by part.
  /// Throws Error unavailable when the device fails.
  void voxelize(const TriangleMesh& mesh, const Request& request, VoxelSet& set,
                const Progress& progress = no_progress);

 private:
  struct Meshed;
  void mark_band(const Meshed& meshed, const RasterGrid& grid, const Request& request, const TileRows& rows);
  void run_tasks(gpu::Kernel& kernel, const Meshed& meshed, const RasterGrid& grid, bool thin,
                 const RowRange& range, const gpu::Buffer& words);

  const gpu::Queue& queue_;
  gpu::Program program_;
  gpu::Kernel mark_, flip_, fill_;
  ThreadPool pool_;
};

}  // namespace ream::voxelizer
