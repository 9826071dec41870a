#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/vec.hpp"

namespace ream::solve {

/// What a modulus may be: beyond, numbers in single precision get lost.
inline constexpr double min_modulus_mpa = 1e-9, max_modulus_mpa = 1e12;
/// Elements with eight corners lock beyond.
inline constexpr double max_poisson = 0.49;

/// Elements on a regular grid of cells, and the corners that they have. Corners are numbered layer after
/// layer, x fastest; each has three degrees of freedom, at 3 corner + axis.
class ElasticGrid {
 public:
  /// `modulus_mpa`: of each cell, x fastest, 0 where there is none. Needs dims > 0 and fewer than 2^31
  /// places.
  ElasticGrid(const Vec3i& dims, const Vec3& cell_mm, std::span<const float> modulus_mpa);

  /// Cells twice as long along each axis. Of the eight in one, the mean modulus; or more where some are empty
  /// or much softer, so that no motion of the coarse corners has more than 1.9 times the energy here that it
  /// has there
  /// (`energy_shares`: of a cell, see BoxElement). What is held here is held there. The last cells may reach
  /// beyond this grid.
  ElasticGrid coarser(const std::array<float, 256>& energy_shares) const;

  const Vec3i& dims() const { return dims_; }
  const Vec3& cell_mm() const { return cell_mm_; }
  size_t corners() const { return corners_; }
  size_t elements() const { return moduli_mpa_.size(); }

  /// Number of the corner at a place of the lattice of dims + 1 places; -1: no element has it.
  int32_t corner_at(const Vec3i& place) const { return corner_of_[lattice_index(place)]; }
  size_t lattice_index(const Vec3i& p) const {
    return static_cast<size_t>(p.x()) + row_ * static_cast<size_t>(p.y()) +
           layer_ * static_cast<size_t>(p.z());
  }
  /// Corners before each layer of the lattice; dims.z + 2 of them.
  std::span<const size_t> layer_corners() const { return layer_corners_; }
  /// The lattice's place of a corner.
  Vec3i place_of(size_t corner) const;

  /// The lattice index of each corner's place.
  std::span<const uint32_t> places() const { return places_; }

  /// Elements before each layer of cells; dims.z + 1 of them.
  std::span<const size_t> layer_elements() const { return layer_elements_; }
  /// Of each element the lattice index of its corner 0, and its modulus.
  const uint32_t* first_places() const { return first_places_.data(); }
  const float* moduli_mpa() const { return moduli_mpa_.data(); }
  const int32_t* corner_of() const { return corner_of_.data(); }
  /// From the lattice index of corner 0 to that of corner c.
  size_t corner_offset(int c) const {
    return static_cast<size_t>(c & 1) + row_ * static_cast<size_t>(c >> 1 & 1) +
           layer_ * static_cast<size_t>(c >> 2 & 1);
  }

  /// Number of corner c of an element.
  size_t corner_of_element(size_t element, int c) const {
    return static_cast<size_t>(corner_of_[first_places_[element] + corner_offset(c)]);
  }

  /// Holds a degree of freedom where it is.
  void hold(size_t corner, int axis) { held_[corner] |= static_cast<uint8_t>(1u << axis); }
  bool is_held(size_t corner, int axis) const { return (held_[corner] >> axis & 1u) != 0; }
  /// Bits of the axes along which each corner is held.
  std::span<const uint8_t> held() const { return held_; }

  /// Sum of the moduli of a corner's elements, each.
  std::vector<float> modulus_sums() const;

 private:
  void number_corners();
  bool coarse_is_held(const Vec3i& coarse_place, int axis) const;

  Vec3i dims_;
  Vec3 cell_mm_;
  size_t row_, layer_, corners_ = 0;
  std::vector<int32_t> corner_of_;
  std::vector<uint32_t> first_places_, places_;
  std::vector<float> moduli_mpa_;
  std::vector<size_t> layer_elements_, layer_corners_;
  std::vector<uint8_t> held_;
};

}  // namespace ream::solve
