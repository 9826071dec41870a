#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/vec.hpp"

namespace ream::bench {

/// A row of the thesis' text file in memory.
struct VoxelRow {
  std::array<float, 3> centre_mm;
  float gray;
};

/// Milliseconds of the thesis' phases (table 2.3), and what came of them.
struct ThesisMesh {
  double grid_ms = 0.0, hexahedra_ms = 0.0, indexing_ms = 0.0, material_ms = 0.0, binning_ms = 0.0,
         sets_ms = 0.0;
  double fair_indexing_ms = 0.0;  ///< by index_by_two_hash_maps(), beside indexing_ms; not in the sum
  uint64_t elements = 0, nodes = 0, materials = 0;

  double sum_ms() const { return grid_ms + hexahedra_ms + indexing_ms + material_ms + binning_ms + sets_ms; }
};

/// The pipeline of thesis sections 2.2 to 2.4: a density array, eight nodes an element, duplicates removed
/// by a hash map, moduli E = slope * gray in bins of `bin_width` (0: none), elements of a material gathered
/// by a second hash map. One thread, as published.
ThesisMesh thesis_mesh(std::span<const VoxelRow> rows, const Vec3i& dims, const Vec3& spacing_mm,
                       double slope, double bin_width);

/// Unique nodes of the 8 n nodes of elements, as table 2.1 finds them; milliseconds.
struct Indexed {
  double ms = 0.0;
  uint64_t nodes = 0;
};
Indexed index_by_nested_loops(const std::vector<std::array<float, 3>>& nodes);
Indexed index_by_hash_map(const std::vector<std::array<float, 3>>& nodes, std::vector<uint32_t>& index);
/// The same result by a fair form: hash maps that have their room from the start, each of two threads with
/// the nodes whose hash says so. Numbers are of the thread's own, then of the other.
Indexed index_by_two_hash_maps(const std::vector<std::array<float, 3>>& nodes, std::vector<uint32_t>& index);
/// Eight nodes for each row, section 2.3.
std::vector<std::array<float, 3>> nodes_of(std::span<const VoxelRow> rows, const Vec3& spacing_mm);

}  // namespace ream::bench
