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

// Voxelizer (server/voxelizer): a task is a triangle and a part of its box, so many rows in so many layers.
#define REAM_VOXELIZER_TASK_ROWS 4
#define REAM_VOXELIZER_TASK_LAYERS 64

// The rows v_begin to v_end of the layers w_begin to w_end of a grid, in words of their own.
struct VoxelizerArguments {
  ream_uint32 tasks;
  ream_int32 dims_x, v_begin, v_end, w_begin, w_end;
  ream_int32 words_per_row, rows_per_layer;
  ream_int32 thin;  // 1: 6-separating (eqs 3.6-3.8), 0: 26-separating (eqs 3.1-3.5)
};

// Affine map, row by row: out_i = m[3i] x + m[3i+1] y + m[3i+2] z + t[i] (collide/grid_transform.hpp).
struct AffineArguments {
  float m[9];
  float t[3];
};

// Narrow phase (collide/contact/contact_shell.hpp, narrow_phase.hpp). A work-group's sums, 64-bit: products
// and points of the cutting, then of the guiding blocks, then weights and densities by class, the resistance, and the
// depth key.
#define REAM_CONTACT_PRODUCTS 24
#define REAM_CONTACT_PART_SUMS 25
#define REAM_CONTACT_CLASS_WEIGHT 50
#define REAM_CONTACT_CLASS_DENSITY 53
#define REAM_CONTACT_RESISTANCE 56
#define REAM_CONTACT_DEEPEST 57
#define REAM_CONTACT_SUMS 58
// Points of a chunk; a work-item of a processor takes them at once. Places and directions are padded by as many.
#define REAM_CONTACT_CHUNK 16
#define REAM_PLACE_BITS 9
#define REAM_AZIMUTH_BITS 10
#define REAM_AZIMUTH_SHIFT 14
// collide/contact/surface_judge.hpp.
#define REAM_JUDGE_TOLERANCE 8
#define REAM_JUDGE_FRACTION_BITS 8
#define REAM_JUDGE_ROTATION_BITS 7
#define REAM_CARTILAGE_CODE 255

// Chunks of the largest block.
#define REAM_CONTACT_BLOCK_CHUNKS 32

struct ContactArguments {
  ream_int32 per_unit[9], normal_rotation[9];  // VoxelTransform
  ream_int32 bits;
  ream_int32 dims[3];
  ream_int32 brick_row, brick_slice;
  ream_int32 first_cortical_code;
  ream_uint32 chunks;
};

struct ContactBlockLayout {
  ream_uint32 guiding, count;
  ream_int32 origin_z_units, height_units;
  ream_int32 whole[REAM_CONTACT_PRODUCTS];
};

struct DueChunkLayout {
  ream_uint32 block, first, count;
  ream_int32 base[3];
};

// A brick whose word of solid cells has changed, for devices with memory of their own.
struct CellPatch {
  ream_uint32 brick, word;
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

// Removal by decay: points of a run, what stands for a point outside bone, and bricks put on the device at once.
#define REAM_DECAY_RUN_POINTS 256
#define REAM_NO_VOXEL 0xffffffffu
#define REAM_DECAY_PUT_BRICKS 512

struct DecayRunLayout {
  ream_uint32 first, count;
};

struct DecayArguments {
  struct AffineArguments voxel_from_tool;
  ream_int32 dims_x, dims_y, dims_z;
  ream_uint32 listed;  // runs
};

// Solver (server/solve): a lattice of dims + 1 places, its rows and layers, and how many of them are corners.
struct ElasticGridLayout {
  ream_uint32 corners, row, layer;
  ream_int32 dims_x, dims_y, dims_z;
};

// Sums: numbers of a part, and how many of them are summed side by side (server/solve/parallel_vectors.hpp).
#define REAM_SOLVE_PART 32768
#define REAM_SOLVE_LANES 128

#ifndef __OPENCL_VERSION__
}  // namespace ream::layout
#endif

#endif
