#include "bench/baselines/thesis_mesher.hpp"

#include <bit>
#include <cmath>
#include <thread>
#include <unordered_map>

#include "core/clock.hpp"

namespace ream::bench {
namespace {

using Node = std::array<float, 3>;

constexpr int corners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                               {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

struct NodeHash {
  size_t operator()(const Node& n) const {
    uint64_t hash = 0;
    for (const float c : n) hash = (hash ^ std::bit_cast<uint32_t>(c)) * 0x9e3779b97f4a7c15u + (hash >> 29);
    return hash ^ hash >> 32;
  }
};

template <typename Phase>
double timed_ms(Phase&& phase) {
  const auto start = SteadyClock::now();
  phase();
  return elapsed_us(start) * 1e-3;
}

struct Grid {
  Vec3 first_mm, spacing_mm;
  Vec3i dims;
  std::vector<float> density;  ///< 0: empty
};

Grid make_grid(std::span<const VoxelRow> rows, const Vec3i& dims, const Vec3& spacing_mm) {
  Grid grid{Vec3::Constant(1e30), spacing_mm, dims, {}};
  for (const VoxelRow& row : rows)
    for (int k = 0; k < 3; ++k)
      grid.first_mm[k] =
          std::min(grid.first_mm[k], static_cast<double>(row.centre_mm[static_cast<size_t>(k)]));
  grid.density.resize(static_cast<size_t>(dims.x()) * static_cast<size_t>(dims.y()) *
                      static_cast<size_t>(dims.z()));
  for (const VoxelRow& row : rows) {
    size_t index[3];
    for (size_t k = 0; k < 3; ++k)
      index[k] = static_cast<size_t>(std::lround((row.centre_mm[k] - grid.first_mm[static_cast<int>(k)]) /
                                                 spacing_mm[static_cast<int>(k)]));
    grid.density[index[0] + static_cast<size_t>(dims.x()) *
                                (index[1] + static_cast<size_t>(dims.y()) * index[2])] = row.gray;
  }
  return grid;
}

/// A corner's coordinate is computed the same way from every voxel that has it, so that equal ones are equal.
std::vector<Node> make_hexahedra(const Grid& grid, std::vector<float>& gray) {
  std::vector<Node> nodes;
  size_t i = 0;
  for (int w = 0; w < grid.dims.z(); ++w)
    for (int v = 0; v < grid.dims.y(); ++v)
      for (int u = 0; u < grid.dims.x(); ++u, ++i) {
        if (grid.density[i] == 0.0f) continue;
        gray.push_back(grid.density[i]);
        const int at[3] = {u, v, w};
        for (const auto& corner : corners) {
          Node node;
          for (int k = 0; k < 3; ++k)
            node[static_cast<size_t>(k)] =
                static_cast<float>(grid.first_mm[k] + (at[k] + corner[k] - 0.5) * grid.spacing_mm[k]);
          nodes.push_back(node);
        }
      }
  return nodes;
}

}  // namespace

std::vector<Node> nodes_of(std::span<const VoxelRow> rows, const Vec3& spacing_mm) {
  std::vector<Node> nodes;
  nodes.reserve(8 * rows.size());
  for (const VoxelRow& row : rows)
    for (const auto& corner : corners) {
      Node node;
      for (size_t k = 0; k < 3; ++k) {
        const double half = spacing_mm[static_cast<int>(k)] * 0.5;
        // On the lattice of half voxels, so that equal corners are equal numbers.
        node[k] =
            static_cast<float>(std::nearbyint((row.centre_mm[k] + (2 * corner[k] - 1) * half) / half) * half);
      }
      nodes.push_back(node);
    }
  return nodes;
}

Indexed index_by_nested_loops(const std::vector<Node>& nodes) {
  std::vector<Node> unique;
  std::vector<uint32_t> index;
  index.reserve(nodes.size());
  Indexed result;
  result.ms = timed_ms([&] {
    for (const Node& node : nodes) {
      size_t i = 0;
      while (i < unique.size() && unique[i] != node) ++i;
      if (i == unique.size()) unique.push_back(node);
      index.push_back(static_cast<uint32_t>(i));
    }
  });
  result.nodes = unique.size();
  return result;
}

Indexed index_by_hash_map(const std::vector<Node>& nodes, std::vector<uint32_t>& index) {
  Indexed result;
  result.ms = timed_ms([&] {
    std::unordered_map<Node, uint32_t, NodeHash> known;
    index.clear();
    index.reserve(nodes.size());
    for (const Node& node : nodes)
      index.push_back(known.try_emplace(node, static_cast<uint32_t>(known.size())).first->second);
    result.nodes = known.size();
  });
  return result;
}

Indexed index_by_two_hash_maps(const std::vector<Node>& nodes, std::vector<uint32_t>& index) {
  Indexed result;
  result.ms = timed_ms([&] {
    std::array<std::unordered_map<Node, uint32_t, NodeHash>, 2> known;
    std::vector<uint8_t> shard(nodes.size());
    index.assign(nodes.size(), 0);
    const auto number = [&](uint8_t own) {
      // Of a solid block each node has eight elements; foam has more nodes an element.
      known[own].reserve(nodes.size() / 8);
      for (size_t i = 0; i < nodes.size(); ++i) {
        const auto hash = static_cast<uint8_t>(NodeHash()(nodes[i]) >> 20 & 1u);
        if (hash != own) continue;
        shard[i] = own;
        index[i] = known[own].try_emplace(nodes[i], static_cast<uint32_t>(known[own].size())).first->second;
      }
    };
    std::thread second([&] { number(1); });
    number(0);
    second.join();
    const auto first = static_cast<uint32_t>(known[0].size());
    for (size_t i = 0; i < nodes.size(); ++i)
      if (shard[i] == 1) index[i] += first;
    result.nodes = known[0].size() + known[1].size();
  });
  return result;
}

ThesisMesh thesis_mesh(std::span<const VoxelRow> rows, const Vec3i& dims, const Vec3& spacing_mm,
                       double slope, double bin_width) {
  ThesisMesh mesh;
  Grid grid;
  mesh.grid_ms = timed_ms([&] { grid = make_grid(rows, dims, spacing_mm); });
  std::vector<float> modulus;
  std::vector<Node> nodes;
  mesh.hexahedra_ms = timed_ms([&] { nodes = make_hexahedra(grid, modulus); });
  grid.density = {};
  std::vector<uint32_t> index;
  const Indexed indexed = index_by_hash_map(nodes, index);
  mesh.indexing_ms = indexed.ms;
  mesh.fair_indexing_ms = index_by_two_hash_maps(nodes, index).ms;
  mesh.nodes = indexed.nodes;
  mesh.elements = modulus.size();
  mesh.material_ms = timed_ms([&] {
    for (float& m : modulus) m = static_cast<float>(slope * static_cast<double>(m));
  });
  if (bin_width > 0.0)
    mesh.binning_ms = timed_ms([&] {
      for (float& m : modulus)
        m = static_cast<float>((std::floor(static_cast<double>(m) / bin_width) + 0.5) * bin_width);
    });
  mesh.sets_ms = timed_ms([&] {
    std::unordered_map<float, std::vector<uint32_t>> sets;
    for (uint32_t i = 0; i < modulus.size(); ++i) sets[modulus[i]].push_back(i + 1);
    mesh.materials = sets.size();
  });
  return mesh;
}

}  // namespace ream::bench
