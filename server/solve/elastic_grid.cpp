#include "solve/elastic_grid.hpp"

#include <algorithm>

namespace ream::solve {

ElasticGrid::ElasticGrid(const Vec3i& dims, const Vec3& cell_mm, std::span<const float> modulus_mpa)
    : dims_(dims),
      cell_mm_(cell_mm),
      row_(static_cast<size_t>(dims.x()) + 1),
      layer_(row_ * (static_cast<size_t>(dims.y()) + 1)) {
  size_t cell = 0;
  for (int w = 0; w < dims.z(); ++w) {
    layer_elements_.push_back(moduli_mpa_.size());
    for (int v = 0; v < dims.y(); ++v)
      for (int u = 0; u < dims.x(); ++u, ++cell) {
        if (!(modulus_mpa[cell] > 0.0f)) continue;
        first_places_.push_back(static_cast<uint32_t>(lattice_index({u, v, w})));
        moduli_mpa_.push_back(modulus_mpa[cell]);
      }
  }
  layer_elements_.push_back(moduli_mpa_.size());
  number_corners();
  held_.assign(corners_, 0);
}

void ElasticGrid::number_corners() {
  const size_t places = layer_ * (static_cast<size_t>(dims_.z()) + 1);
  corner_of_.assign(places, -1);
  for (const uint32_t first : first_places_)
    for (int c = 0; c < 8; ++c) corner_of_[first + corner_offset(c)] = 0;
  for (size_t place = 0; place < places; ++place) {
    if (place % layer_ == 0) layer_corners_.push_back(corners_);
    if (corner_of_[place] < 0) continue;
    corner_of_[place] = static_cast<int32_t>(corners_++);
    places_.push_back(static_cast<uint32_t>(place));
  }
  layer_corners_.push_back(corners_);
}

Vec3i ElasticGrid::place_of(size_t corner) const {
  const uint32_t place = places_[corner], row = static_cast<uint32_t>(row_),
                 layer = static_cast<uint32_t>(layer_);
  const uint32_t z = place / layer, in_layer = place - z * layer, y = in_layer / row;
  return {static_cast<int>(in_layer - y * row), static_cast<int>(y), static_cast<int>(z)};
}

/// Where it coincides with a corner of this grid, as that one; else where all that it moves are held.
bool ElasticGrid::coarse_is_held(const Vec3i& coarse_place, int axis) const {
  const Vec3i middle = 2 * coarse_place;
  const auto corner = [&](const Vec3i& place) {
    const bool inside = (place.array() >= 0).all() && (place.array() <= dims_.array()).all();
    return inside ? corner_at(place) : -1;
  };
  if (const int32_t same = corner(middle); same >= 0) return is_held(static_cast<size_t>(same), axis);
  for (int i = 0; i < 27; ++i) {
    const int32_t near = corner(middle + Vec3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
    if (near >= 0 && !is_held(static_cast<size_t>(near), axis)) return false;
  }
  return true;
}

ElasticGrid ElasticGrid::coarser(const std::array<float, 256>& energy_shares) const {
  // A coarse step goes too far, and a cycle makes things worse, from twice the energy on.
  constexpr float allowed = 1.9f;
  const Vec3i dims = (dims_.array() + 1) / 2;
  const auto cells = static_cast<size_t>(dims.cast<int64_t>().prod());
  std::vector<float> moduli(cells, 0.0f), greatest(cells, 0.0f);
  std::vector<uint8_t> octants(cells, 0);
  for (size_t e = 0; e < elements(); ++e) {
    const size_t place = first_places_[e];
    const Vec3i at(static_cast<int>(place % row_), static_cast<int>(place % layer_ / row_),
                   static_cast<int>(place / layer_));
    const Vec3i coarse = at / 2, octant = at - 2 * coarse;
    const size_t coarse_row =
        static_cast<size_t>(coarse.y()) + static_cast<size_t>(dims.y()) * static_cast<size_t>(coarse.z());
    const size_t cell = static_cast<size_t>(coarse.x()) + static_cast<size_t>(dims.x()) * coarse_row;
    moduli[cell] += 0.125f * moduli_mpa_[e];
    greatest[cell] = std::max(greatest[cell], moduli_mpa_[e]);
    octants[cell] =
        static_cast<uint8_t>(octants[cell] | 1u << (octant.x() + 2 * octant.y() + 4 * octant.z()));
  }
  for (size_t cell = 0; cell < cells; ++cell)
    moduli[cell] = std::max(moduli[cell], greatest[cell] * energy_shares[octants[cell]] / allowed);
  ElasticGrid coarse(dims, 2.0 * cell_mm_, moduli);
  for (size_t corner = 0; corner < coarse.corners(); ++corner)
    for (int axis = 0; axis < 3; ++axis)
      if (coarse_is_held(coarse.place_of(corner), axis)) coarse.hold(corner, axis);
  return coarse;
}

std::vector<float> ElasticGrid::modulus_sums() const {
  std::vector<float> sums(corners_, 0.0f);
  for (size_t e = 0; e < elements(); ++e)
    for (int c = 0; c < 8; ++c) sums[corner_of_element(e, c)] += moduli_mpa_[e];
  return sums;
}

}  // namespace ream::solve
