#include "solve/elastic_operator.hpp"

#include <algorithm>

#include "core/vector_clones.hpp"

namespace ream::solve {
namespace {

/// Elements that are worked on side by side, one in each lane of a vector.
constexpr size_t lanes = 8;

template <typename Real>
using Lane = Real[lanes];

/// Component k of corner c at [3 c + k]; afterwards of mode m at [3 m + k], and back.
template <typename Real>
inline __attribute__((always_inline)) void sums_and_differences(Lane<Real>* values) {
  for (int bit = 1; bit < 8; bit *= 2)
    for (int c = 0; c < 8; ++c) {
      if ((c & bit) != 0) continue;
      for (int k = 0; k < 3; ++k)
        for (size_t e = 0; e < lanes; ++e) {
          const Real low = values[3 * c + k][e], high = values[3 * (c | bit) + k][e];
          values[3 * c + k][e] = low + high;
          values[3 * (c | bit) + k][e] = low - high;
        }
    }
}

template <typename Real>
inline __attribute__((always_inline)) void multiply_blocks(const std::array<Real, 9>* blocks,
                                                           Lane<Real>* modes) {
  for (size_t parity = 0; parity < 8; ++parity) {
    const Real* b = blocks[parity].data();
    Real* x = modes[3 * (parity ^ 1)];
    Real* y = modes[3 * (parity ^ 2) + 1];
    Real* z = modes[3 * (parity ^ 4) + 2];
    for (size_t e = 0; e < lanes; ++e) {
      const Real u = x[e], v = y[e], w = z[e];
      x[e] = b[0] * u + b[1] * v + b[2] * w;
      y[e] = b[3] * u + b[4] * v + b[5] * w;
      z[e] = b[6] * u + b[7] * v + b[8] * w;
    }
  }
}

/// What one layer of elements adds to the forces on its corners.
template <typename Real>
struct LayerWork {
  const uint32_t* first_places;
  const float* moduli_mpa;
  const int32_t* corner_of;
  const uint32_t* offsets;
  const std::array<Real, 9>* blocks;
  const Real* displacements;
  Real* forces;
};

template <typename Real>
inline __attribute__((always_inline)) void add_forces(const LayerWork<Real>& work, size_t first,
                                                      size_t last) {
  alignas(64) Lane<Real> values[24];
  alignas(64) Real modulus[lanes];
  size_t dofs[8][lanes];
  for (size_t begin = first; begin < last; begin += lanes) {
    const size_t count = std::min(lanes, last - begin);
    for (size_t e = 0; e < lanes; ++e) {
      const size_t element = begin + std::min(e, count - 1);
      modulus[e] = static_cast<Real>(work.moduli_mpa[element]);
      for (size_t c = 0; c < 8; ++c) {
        const size_t dof =
            3 * static_cast<size_t>(work.corner_of[work.first_places[element] + work.offsets[c]]);
        dofs[c][e] = dof;
        for (size_t k = 0; k < 3; ++k) values[3 * c + k][e] = work.displacements[dof + k];
      }
    }
    sums_and_differences(values);
    multiply_blocks(work.blocks, values);
    sums_and_differences(values);
    for (auto& value : values)
      for (size_t e = 0; e < lanes; ++e) value[e] *= modulus[e];
    for (size_t e = 0; e < count; ++e)
      for (size_t c = 0; c < 8; ++c)
        for (size_t k = 0; k < 3; ++k) work.forces[dofs[c][e] + k] += values[3 * c + k][e];
  }
}

REAM_VECTOR_CLONES void add_layer(const LayerWork<float>& work, size_t first, size_t last) {
  add_forces(work, first, last);
}
REAM_VECTOR_CLONES void add_layer(const LayerWork<double>& work, size_t first, size_t last) {
  add_forces(work, first, last);
}

}  // namespace

template <typename Real>
ElasticOperator<Real>::ElasticOperator(const ElasticGrid& grid, double poisson) : grid_(grid) {
  const BoxElement box(grid.cell_mm(), poisson);
  diagonal_ = box.diagonal;
  greatest_ = box.greatest_over_diagonal();
  for (size_t parity = 0; parity < 8; ++parity)
    for (size_t i = 0; i < 9; ++i) blocks_[parity][i] = static_cast<Real>(box.blocks[parity][i]);
  for (int c = 0; c < 8; ++c) offsets_[static_cast<size_t>(c)] = static_cast<uint32_t>(grid.corner_offset(c));
}

/// Layers of every second number share no corner. First the even ones, then the odd ones: each corner's sum
/// has the same order whoever works on what.
template <typename Real>
void ElasticOperator<Real>::apply_with_reactions(std::span<const Real> displacements, std::span<Real> forces,
                                                 ThreadPool& pool) const {
  std::fill(forces.begin(), forces.end(), Real{0});
  const LayerWork<Real> work{grid_.first_places(), grid_.moduli_mpa(),   grid_.corner_of(), offsets_.data(),
                             blocks_.data(),       displacements.data(), forces.data()};
  const auto layers = static_cast<size_t>(grid_.dims().z());
  for (size_t parity = 0; parity < 2; ++parity)
    pool.run((layers + 1 - parity) / 2, [&](size_t piece, int) {
      const size_t layer = 2 * piece + parity;
      add_layer(work, grid_.layer_elements()[layer], grid_.layer_elements()[layer + 1]);
    });
}

template <typename Real>
void ElasticOperator<Real>::apply(std::span<const Real> displacements, std::span<Real> forces,
                                  ThreadPool& pool) const {
  apply_with_reactions(displacements, forces, pool);
  const std::span<const uint8_t> held = grid_.held();
  for (size_t corner = 0; corner < held.size(); ++corner) {
    if (held[corner] == 0) continue;
    for (size_t axis = 0; axis < 3; ++axis)
      if ((held[corner] >> axis & 1u) != 0) forces[3 * corner + axis] = Real{0};
  }
}

template <typename Real>
std::vector<Real> ElasticOperator<Real>::inverse_diagonal() const {
  const std::vector<float> sums = grid_.modulus_sums();
  std::vector<Real> inverse(3 * grid_.corners());
  for (size_t corner = 0; corner < grid_.corners(); ++corner)
    for (int axis = 0; axis < 3; ++axis)
      inverse[3 * corner + static_cast<size_t>(axis)] =
          grid_.is_held(corner, axis) ? Real{0}
                                      : static_cast<Real>(1.0 / (diagonal_[axis] * double{sums[corner]}));
  return inverse;
}

template class ElasticOperator<float>;
template class ElasticOperator<double>;

}  // namespace ream::solve
