#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "voxel/bone_model.hpp"

namespace ream::voxel {

/// A voxel with at least this coverage is solid: the surface lies where coverage crosses 127.5.
inline constexpr int solid_coverage = 128;

/// Edge of a cell in voxels; a brick has 2^3 cells, numbered x fastest.
inline constexpr int cell_edge = 4;

/// Where bone is, 4^3 voxels at a time and in two bits each, so that most points of a tool are told to lie in
/// bone or in the air without touching the grid; and the box around it. Kept up to date by the one writer of
/// the grid, brick by brick. Bone only becomes less.
class SolidCells {
 public:
  explicit SolidCells(const BoneModel& bone);

  /// Word of a brick's 512 coverages: bit k is set when cell k has a voxel with any bone, bit 8 + k when all
  /// its voxels are full of it.
  static uint16_t word_of(const uint8_t* brick_coverage) noexcept;

  /// Takes over what removal has left of a brick.
  void set(uint32_t brick, uint16_t word) noexcept;

  uint16_t word(uint32_t brick) const noexcept { return words_[brick]; }
  /// One word a brick, and one more, so that any of them may be read as part of four bytes.
  const std::vector<uint16_t>& words() const noexcept { return words_; }
  const Vec3i& brick_dims() const noexcept { return brick_dims_; }

  /// Around all cells with bone, mm, grid frame: shrinks as bone goes; empty when none is left.
  Aabb bounds_mm() const noexcept;

 private:
  void count(uint32_t brick, uint16_t word, int sign) noexcept;
  void shrink() noexcept;

  Vec3i brick_dims_;
  Vec3 cell_mm_;
  std::vector<uint16_t> words_;
  /// Per axis: bricks that have bone in each layer of cells, and the outermost layers that have some.
  std::array<std::vector<int32_t>, 3> bricks_in_layer_;
  Vec3i low_ = Vec3i::Zero(), high_ = Vec3i::Zero();
};

}  // namespace ream::voxel
