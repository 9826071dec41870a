#include "voxel/solid_cells.hpp"

#include <cstring>

namespace ream::voxel {
namespace {

/// Cells of a brick that lie in its low (0) or high (1) half along each axis.
constexpr uint8_t half_of_brick[3][2] = {{0x55, 0xaa}, {0x33, 0xcc}, {0x0f, 0xf0}};

}  // namespace

SolidCells::SolidCells(const BoneModel& bone)
    : brick_dims_(bone.grid.brick_dims()),
      cell_mm_(bone.grid.spacing_mm * cell_edge),
      words_(bone.grid.brick_count() + 1) {
  for (size_t axis = 0; axis < 3; ++axis)
    bricks_in_layer_[axis].resize(2 * static_cast<size_t>(brick_dims_[static_cast<Eigen::Index>(axis)]));
  high_ = 2 * brick_dims_ - Vec3i::Ones();
  for (uint32_t b = 0; b < bone.grid.brick_count(); ++b) {
    words_[b] = word_of(bone.coverage.data() + bone.grid.brick_base(b));
    count(b, words_[b], 1);
  }
  shrink();
}

uint16_t SolidCells::word_of(const uint8_t* brick_coverage) noexcept {
  // A row of eight voxels crosses two cells, its low and its high half.
  uint32_t word = 0;
  for (int pair = 0; pair < 4; ++pair) {
    const uint8_t* first_row = brick_coverage + (pair % 2) * cell_edge * 8 + (pair / 2) * cell_edge * 64;
    uint64_t some = 0, all = ~uint64_t{0};
    for (int w = 0; w < cell_edge; ++w)
      for (int v = 0; v < cell_edge; ++v) {
        uint64_t row;
        std::memcpy(&row, first_row + w * 64 + v * 8, sizeof row);
        some |= row;
        all &= row;
      }
    for (int half = 0; half < 2; ++half) {
      const auto some_half = static_cast<uint32_t>(some >> (32 * half)),
                 all_half = static_cast<uint32_t>(all >> (32 * half));
      word |= static_cast<uint32_t>(some_half != 0) << (2 * pair + half);
      word |= static_cast<uint32_t>(all_half == 0xffffffffu) << (8 + 2 * pair + half);
    }
  }
  return static_cast<uint16_t>(word);
}

void SolidCells::set(uint32_t brick, uint16_t word) noexcept {
  const uint16_t old = words_[brick];
  if (old == word) return;
  words_[brick] = word;
  if ((old & 0xff) == (word & 0xff)) return;
  count(brick, old, -1);
  count(brick, word, 1);
  shrink();
}

void SolidCells::count(uint32_t brick, uint16_t word, int sign) noexcept {
  const auto b = static_cast<int>(brick);
  const int at[3] = {b % brick_dims_.x(), (b / brick_dims_.x()) % brick_dims_.y(),
                     b / (brick_dims_.x() * brick_dims_.y())};
  for (size_t axis = 0; axis < 3; ++axis)
    for (size_t half = 0; half < 2; ++half)
      if (word & half_of_brick[axis][half])
        bricks_in_layer_[axis][2 * static_cast<size_t>(at[axis]) + half] += sign;
}

void SolidCells::shrink() noexcept {
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const auto& layers = bricks_in_layer_[axis];
    while (low_[i] <= high_[i] && layers[static_cast<size_t>(low_[i])] == 0) ++low_[i];
    while (high_[i] >= low_[i] && layers[static_cast<size_t>(high_[i])] == 0) --high_[i];
  }
}

Aabb SolidCells::bounds_mm() const noexcept {
  Aabb box;
  if ((low_.array() > high_.array()).any()) return box;
  box.include((low_.cast<double>().array() * cell_mm_.array()).matrix());
  box.include(((high_.cast<double>().array() + 1.0) * cell_mm_.array()).matrix());
  return box;
}

}  // namespace ream::voxel
