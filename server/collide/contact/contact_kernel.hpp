#pragma once
#include <span>

#include "collide/contact/narrow_phase.hpp"

// Inside of the C++ narrow phase: looks at sixteen points at a time, in a portable form and one for AVX-512.
namespace ream::collide {

/// What all chunks of one look share; plain pointers and numbers for inner loops.
struct ContactView {
  const uint32_t* places;
  const uint16_t* directions;
  const uint32_t* normals;
  const ContactBlock* blocks;
  const DirectionTable* table;
  const uint16_t* cells;    ///< SolidCells::words
  const uint8_t* coverage;  ///< grid order
  const uint8_t* density;
  const uint32_t* resistances;  ///< by density code
  int32_t dims[3];
  int32_t brick_row, brick_slice;  ///< bricks per row and per layer
  int32_t first_cortical_code;     ///< lowest density code of cortical bone
  std::array<int32_t, 9> per_unit, normal_rotation;
  int bits;

  void look_from(const VoxelTransform& transform) noexcept {
    per_unit = transform.per_unit;
    normal_rotation = transform.normal_rotation;
    bits = transform.bits;
  }
};

/// The view of one look; what does not change between looks is taken from `input`.
ContactView contact_view(const NarrowPhaseInput& input) noexcept;

/// Up to sixteen consecutive points of a block that are to be looked at, and where the block's origin lies
/// (VoxelTransform::base).
struct DueChunk {
  uint32_t block;
  uint32_t first, count;  ///< points
  std::array<int32_t, 3> base;
};

/// How far every probe is from bone, told by what the corners of a cube around it meet: cubes a little
/// smaller than a brick or a cell reach into no more than eight of them.
enum class Clearance { brick, cell };
/// Half the cube's edge.
constexpr float cube_reach_voxels(Clearance clearance) {
  return clearance == Clearance::brick ? 3.875f : 1.875f;
}
/// How far a probe may move from there without touching: a point may be judged by a voxel next to its own.
constexpr float clearance_voxels(Clearance clearance) { return cube_reach_voxels(clearance) - 1.0f; }

/// The chunk moved to one of the eight corners of the cube of that clearance around it.
DueChunk shifted(const ContactView& view, const DueChunk& chunk, Clearance clearance, int corner) noexcept;

/// Adds the engaged points of the chunks, which are in rising order, to the sums; touched[i] becomes 1 when
/// chunk i has any, else 0.
using Look = void (*)(const ContactView&, std::span<const DueChunk>, uint8_t* touched, ContactSums&) noexcept;
/// True when no probe of the chunk comes nearer to bone than that.
using IsClear = bool (*)(const ContactView&, const DueChunk&, Clearance) noexcept;

struct ContactKernels {
  Look look = nullptr;
  IsClear is_clear = nullptr;
};

ContactKernels portable_contact_kernels() noexcept;
/// The form for AVX-512; empty where compiler or processor have none. Same bits.
ContactKernels avx512_contact_kernels() noexcept;
ContactKernels best_contact_kernels() noexcept;

}  // namespace ream::collide
