#include "shell/surface_voxelizer_cl.hpp"

#include <span>

#include "kernels/layout.h"
#include "shell/surface_corners.hpp"

namespace ream::shell {
namespace {

constexpr size_t local_size = 16;

}  // namespace

SurfaceVoxelizerCl::SurfaceVoxelizerCl(const gpu::Queue& queue)
    : queue_(queue), program_(queue, "surface_voxelizer.cl"), kernel_(program_, "voxelize_surface") {
  const gpu::Buffer nothing(queue, sizeof(uint32_t));
  kernel_.set_all(nothing, layout::SurfaceVoxelizerArguments{}, nothing);
  kernel_.enqueue(queue, local_size, local_size);
  queue.finish();
}

void SurfaceVoxelizerCl::voxelize(const TriangleMesh& mesh, Separability separability, SurfaceVoxels& grid) {
  const std::vector<float> corners = surface_corners(mesh, grid);
  const layout::SurfaceVoxelizerArguments arguments{static_cast<uint32_t>(mesh.triangles.size()),
                                                    grid.dims.x(),
                                                    grid.dims.y(),
                                                    grid.dims.z(),
                                                    grid.words_per_row(),
                                                    separability == Separability::six};
  const gpu::Buffer corner_buffer = gpu::Buffer::over(queue_, std::span(corners));
  const gpu::Buffer word_buffer = gpu::Buffer::over(queue_, std::span(grid.words));
  kernel_.set_all(corner_buffer, arguments, word_buffer);
  kernel_.enqueue(queue_, mesh.triangles.size(), local_size);
  queue_.finish();
  if (!word_buffer.shared())
    word_buffer.read(queue_, grid.words.data(), grid.words.size() * sizeof(uint32_t));
}

}  // namespace ream::shell
