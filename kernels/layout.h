// Structures and constants shared by C++ and OpenCL C: 4-byte members only, so that both lay them out alike.
#ifndef REAM_KERNELS_LAYOUT_H
#define REAM_KERNELS_LAYOUT_H

#ifdef __OPENCL_VERSION__
typedef uint ream_uint32;
typedef int ream_int32;
#else
#include <cstdint>
namespace ream::layout {
using ream_uint32 = std::uint32_t;
using ream_int32 = std::int32_t;
#endif

// Surface voxelizer: rounding margins in units of the largest terms, powers of two (2^-21 and 2^-19). They cover
// the rounding of the float tests, so that no cell that a triangle touches is missed.
#define REAM_VOXELIZER_EDGE_MARGIN 4.76837158203125e-7f
#define REAM_VOXELIZER_PLANE_MARGIN 1.9073486328125e-6f
#define REAM_VOXELIZER_FLOATS_PER_TRIANGLE 9

struct SurfaceVoxelizerArguments {
  ream_uint32 triangles;
  ream_int32 dims_x, dims_y, dims_z;
  ream_int32 words_per_row;
  ream_int32 thin;  // 1: 6-separating (eqs 3.6-3.8), 0: 26-separating (eqs 3.1-3.5)
};

#ifndef __OPENCL_VERSION__
}  // namespace ream::layout
#endif

#endif
