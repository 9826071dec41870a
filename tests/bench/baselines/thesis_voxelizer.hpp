#pragma once
#include <vector>

#include "gpu/program.hpp"
#include "voxelizer/raster_grid.hpp"

namespace ream::bench {

/// The thesis' mesh data (section 3.2): nine floats a triangle, in voxels of the grid.
std::vector<float> thesis_corners(const TriangleMesh& mesh, const voxelizer::RasterGrid& grid);

/// The voxelizers that chapter 3 measures and compares with, 26-separating, on an OpenCL device: the thesis'
/// kernel, which invokes the whole separating-axis test (eqs 3.1-3.5) for every pair of a triangle and a
/// voxel of its box, as in the kernels that its author published; the same with edges, normal and offsets
/// computed once a triangle; and that with the columns' bounds of Schwarz and Seidel (2010). Bits as in
/// voxelizer::VoxelSet.
class ThesisVoxelizer {
 public:
  ThesisVoxelizer(const gpu::Queue& queue, const TriangleMesh& mesh, const voxelizer::RasterGrid& grid);
  /// One kernel over a grid that was cleared, as far as the bits on the device.
  void by_pair() { run(pair_); }
  void by_voxel() { run(sat_); }
  void by_column() { run(column_); }
  const std::vector<uint32_t>& words();

 private:
  void run(gpu::Kernel& kernel);

  const gpu::Queue& queue_;
  const voxelizer::RasterGrid grid_;
  std::vector<float> corners_;
  std::vector<uint32_t> words_;
  gpu::Program program_;
  gpu::Kernel pair_, sat_, column_;
  gpu::Buffer corner_buffer_, word_buffer_;
};

/// The thesis' serial C++ form, on one thread: of by_pair, and of by_voxel. `words` must be 0.
void thesis_voxelizer_serial(const std::vector<float>& corners, const voxelizer::RasterGrid& grid,
                             std::vector<uint32_t>& words);
void set_up_once_serial(const std::vector<float>& corners, const voxelizer::RasterGrid& grid,
                        std::vector<uint32_t>& words);

/// The second of them on two threads, half of the triangles each, as CPU voxelizers are run.
void set_up_once_threads(const std::vector<float>& corners, const voxelizer::RasterGrid& grid,
                         std::vector<uint32_t>& words);

/// Pairs of triangle and voxel that are tested: all voxels of each triangle's box (table 3.1, TB).
uint64_t triangle_based_tests(const std::vector<float>& corners, const voxelizer::RasterGrid& grid);

/// Solid fill as the thesis' author published it: a voxel is inside when on each of the three axes it lies
/// between the first and the last surface voxel of its line. Fills cavities and whatever is concave on all
/// axes. On two threads; `surface` as words of a VoxelSet.
std::vector<uint32_t> first_and_last_hit_fill(const std::vector<uint32_t>& surface,
                                              const voxelizer::RasterGrid& grid);

}  // namespace ream::bench
