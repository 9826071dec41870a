#pragma once
#include "fe/hex_sum.hpp"
#include "fe/mesh_check.hpp"

namespace ream::fe {

// check_mesh_file() by format.
MeshFacts check_inp(const std::filesystem::path& path, const MemoryBudget& budget, const Progress& progress,
                    const ElementVisitor& visit);
MeshFacts check_vtu(const std::filesystem::path& path, const MemoryBudget& budget, const Progress& progress,
                    const ElementVisitor& visit);

/// How many nodes' coordinates may be at hand at once.
inline uint64_t most_nodes_at_hand(const MemoryBudget& budget) {
  return std::min<uint64_t>(budget.left() / (2 * sizeof(Vec3)), uint64_t{1} << 31);
}

}  // namespace ream::fe
