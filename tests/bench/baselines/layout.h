// Structures shared by C++ and the baselines' OpenCL C: 4-byte members only, so that both lay them out alike.
#ifndef REAM_BENCH_BASELINES_LAYOUT_H
#define REAM_BENCH_BASELINES_LAYOUT_H

#ifdef __OPENCL_VERSION__
#pragma OPENCL FP_CONTRACT OFF
typedef uint baseline_uint32;
typedef int baseline_int32;
#else
#include <cstdint>
namespace ream::bench::layout {
using baseline_uint32 = std::uint32_t;
using baseline_int32 = std::int32_t;
#endif

// Affine map, row by row: out_i = m[3i] x + m[3i+1] y + m[3i+2] z + t[i] (collide/grid_transform.hpp).
struct BaselineAffine {
  float m[9];
  float t[3];
};

// Everything that one tick of the flat kernel exchanges with the device, in one buffer as thesis 4.6.2 does:
// arguments, then results.
struct FlatExchange {
  struct BaselineAffine voxel_from_tool;
  float voi_low[3], voi_high[3];  // mm, tool frame
  float origin[3], spacing;       // of the shell's cells, mm
  float centre[3], force_scale;   // what the elemental forces point to; force units per gray level and mm
  baseline_int32 dims[3];
  baseline_uint32 points;
  baseline_uint32 decay;  // gray levels that a point takes from its voxel
  baseline_int32 force[3], inside;
};

struct ZhengArguments {
  struct BaselineAffine voxel_from_tool;
  float centre[3], force_scale;
  baseline_int32 dims[3];
  baseline_int32 root_edge;  // of the cube that is divided: the power of two that holds the grid
  baseline_uint32 points;
};

struct ThesisVoxelizerArguments {
  baseline_uint32 triangles;
  baseline_int32 dims[3];
  baseline_int32 words_per_row;
};

// One tick of the voxel-parallel baseline: arguments, then results.
struct YauExchange {
  struct BaselineAffine tool_from_voxel;
  baseline_int32 low[3], size[3];  // volume of interest, voxels
  baseline_int32 dims[3];
  float inverse_a2, inverse_b2;  // of the cap's semi-axes across and along, 1/mm^2
  float centre_z, plane_z;       // mm
  baseline_int32 collided, gray_sixteenths;
};

#ifndef __OPENCL_VERSION__
}  // namespace ream::bench::layout
#endif

#endif
