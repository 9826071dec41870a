#pragma once
#include "collide/narrow_phase.hpp"

// Inside of the C++ narrow phase: one surviving block at a time, in a portable form and one for AVX-512.
namespace ream::collide {

inline constexpr size_t most_block_points = 512;

/// What all blocks of one look at the bone share; plain pointers and numbers for inner loops.
struct ContactView {
  const uint32_t* places;
  const uint16_t* directions;
  const ContactBlock* blocks;
  const DirectionTable* table;
  const uint16_t* cells;    ///< SolidCells::words
  const uint8_t* coverage;  ///< grid order
  const uint8_t* density;
  int32_t dims[3];
  int32_t brick_row, brick_slice;  ///< bricks per row and per layer
  int32_t first_cortical_code;     ///< lowest density code of cortical bone
  std::array<int32_t, 9> per_unit;
  int bits;
};

/// The view of one look; what does not change between looks is taken from `input`.
ContactView contact_view(const NarrowPhaseInput& input) noexcept;

/// A block to visit, and where its origin lies (VoxelTransform::base).
struct SurvivingBlock {
  uint32_t block;
  std::array<int32_t, 3> base;
};

/// How far every probe of a block is from solid bone, told by what the corners of a cube around it meet:
/// cubes a little smaller than twice a brick, a cell or a voxel reach into no more than eight of them.
enum class Clearance { brick, cell, voxel };
constexpr float clearance_voxels(Clearance clearance) {
  return clearance == Clearance::brick ? 3.875f : clearance == Clearance::cell ? 1.875f : 0.4375f;
}

/// Adds a block's engaged points to the sums and returns how many there are.
using AddBlock = uint32_t (*)(const ContactView&, const SurvivingBlock&, ContactSums&) noexcept;
/// True when no probe of the block comes nearer to solid bone than that.
using IsClear = bool (*)(const ContactView&, const SurvivingBlock&, Clearance) noexcept;

struct BlockFunctions {
  AddBlock add = nullptr;
  IsClear clear = nullptr;
};

/// The block moved to one of the eight corners of the cube of that clearance around it.
SurvivingBlock shifted(const ContactView& view, const SurvivingBlock& at, Clearance clearance,
                       int corner) noexcept;

BlockFunctions portable_block_functions() noexcept;
/// The form for AVX-512; empty where compiler or processor have none. Same bits.
BlockFunctions avx512_block_functions() noexcept;
inline BlockFunctions best_block_functions() noexcept {
  const BlockFunctions best = avx512_block_functions();
  return best.add != nullptr ? best : portable_block_functions();
}

}  // namespace ream::collide
