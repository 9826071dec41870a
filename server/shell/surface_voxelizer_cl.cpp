#include "shell/surface_voxelizer_cl.hpp"

#include <span>

#include "gpu/program.hpp"
#include "kernels/layout.h"
#include "shell/surface_corners.hpp"

namespace ream::shell {

void voxelize_surface_cl(const gpu::Queue& queue, const TriangleMesh& mesh, Separability separability,
                         SurfaceVoxels& grid) {
  constexpr size_t local_size = 16;
  const std::vector<float> corners = surface_corners(mesh, grid);
  const layout::SurfaceVoxelizerArguments arguments{static_cast<uint32_t>(mesh.triangles.size()),
                                                    grid.dims.x(),
                                                    grid.dims.y(),
                                                    grid.dims.z(),
                                                    grid.words_per_row(),
                                                    separability == Separability::six};
  const gpu::Program program(queue, "surface_voxelizer.cl");
  gpu::Kernel kernel(program, "voxelize_surface");
  const gpu::Buffer corner_buffer = gpu::Buffer::over(queue, std::span(corners));
  const gpu::Buffer word_buffer = gpu::Buffer::over(queue, std::span(grid.words));
  kernel.set_all(corner_buffer, arguments, word_buffer);
  kernel.enqueue(queue, mesh.triangles.size(), local_size);
  queue.finish();
  if (!word_buffer.shared()) word_buffer.read(queue, grid.words.data(), grid.words.size() * sizeof(uint32_t));
}

}  // namespace ream::shell
