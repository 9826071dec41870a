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

/// Adds a block's engaged points to the sums.
using AddBlock = void (*)(const ContactView&, const SurvivingBlock&, ContactSums&) noexcept;

void add_block_portable(const ContactView& view, const SurvivingBlock& at, ContactSums& sums) noexcept;

/// The form for AVX-512; nullptr where compiler or processor have none. Same bits.
AddBlock add_block_avx512() noexcept;

}  // namespace ream::collide
