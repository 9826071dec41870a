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

// Affine map, row by row: out_i = m[3i] x + m[3i+1] y + m[3i+2] z + t[i] (collide/grid_affine.hpp).
struct AffineArguments {
  float m[9];
  float t[3];
};

// Narrow phase: one work-group's sums, 64-bit. For the cutting points, then for the others: seven rows of eight products
// w g_i g_j (g of collide/contact_shell.hpp, row 6 holds the first moments), then the counts.
#define REAM_CONTACT_PART_SUMS 56
#define REAM_CONTACT_CUTTING 0
#define REAM_CONTACT_GUIDING 56
#define REAM_CONTACT_CUTTING_POINTS 112
#define REAM_CONTACT_GUIDING_POINTS 113
#define REAM_CONTACT_CLASS_POINTS 114
#define REAM_CONTACT_CLASS_DENSITY 117
#define REAM_CONTACT_SUMS 120
// Points that one work-item decodes at once; the probe arrays are padded by as many.
#define REAM_CONTACT_CHUNK 16
// Longest run of points between two additions to the 64-bit sums; 512 points of weight 28 and components 127 stay below 2^31.
#define REAM_CONTACT_RUN 512
#define REAM_ENGAGING_COVERAGE 128
#define REAM_OCCUPANCY_EDGE 4

struct ContactArguments {
  struct AffineArguments voxel_from_tool;
  ream_int32 dims_x, dims_y, dims_z;
  ream_uint32 survivors;
};

struct ContactBlock {
  ream_uint32 first, count;
};

#define REAM_UNTOUCHED_LEVELS 1.0e9f
// Removal: what became of one listed brick; starts the brick's slot in the kernel's answer.
struct RemovalRecord {
  ream_uint32 hash_low, hash_high;  // sum of the changes' hashes, modulo 2^64
  ream_int32 removed[3];            // coverage levels by bone class
  ream_uint32 changed;
  float slack_levels;  // least level above its coverage of any voxel left; REAM_UNTOUCHED_LEVELS when none is
  ream_uint32 unused;
};

struct RemovalArguments {
  struct AffineArguments tool_from_voxel;
  ream_int32 brick_dims_x, brick_dims_y;
  ream_uint32 bricks;
  ream_uint32 slot_bytes;  // a RemovalRecord each, or a record and the brick's 512 coverages for the host
  ream_int32 r2_count;
  float z_min_mm, inverse_z_step, inverse_r2_step, r2_limit, z_limit, levels_per_step;
};

// Upsampling: where an output sample lies between two input samples (voxel/upsample.hpp).
struct UpsampleTapLayout {
  ream_int32 low, high;
  ream_uint32 low_weight, high_weight;
};

struct UpsampleArguments {
  ream_uint32 input_x, input_y;    // samples a row, rows a slice
  ream_uint32 output_x, output_y;  // the same of the output
  ream_uint32 first_slice;         // of the output slab being made
  ream_uint32 rounding, divisor;   // 4 N^3 and 8 N^3
};

#ifndef __OPENCL_VERSION__
}  // namespace ream::layout
#endif

#endif
