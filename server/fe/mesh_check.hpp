#pragma once
#include <array>
#include <filesystem>
#include <functional>

#include "core/progress.hpp"
#include "fe/make_mesh.hpp"
#include "fe/mesh_writers.hpp"

namespace ream::fe {

/// What was found in a mesh file.
struct MeshFacts {
  uint64_t nodes = 0, elements = 0, materials = 0;
  double volume_mm3 = 0.0;
  double min_jacobian_mm3 = 0.0;  ///< of all corners of all elements: the volume that one spans there
};

/// The corners of an element in the order of fig. 2.2, mesh frame, mm.
using HexCorners = std::array<Vec3, 8>;
using ElementVisitor = std::function<void(const HexCorners& corners)>;

/// Reads a mesh file anew, with nothing of what wrote it: ids positive and given once; elements of eight
/// different nodes that exist, and no node without an element; a positive Jacobian at every corner; each
/// element in exactly one section, whose material has E > 0 and -1 < nu < 0.5 (.inp), or with a gray value,
/// modulus and material (.vtu); volume. Calls visit for every element. Memory follows the budget as long as
/// nodes stand in the order of their ids. Throws Error invalid_input that names the file and what is wrong
/// where; io; what `progress` throws.
MeshFacts check_mesh_file(const std::filesystem::path& path, MeshFormat format, const MemoryBudget& budget,
                          const Progress& progress = no_progress, const ElementVisitor& visit = {});

/// The same, held against what was to be written: each voxel of the mask is one element, and nothing else
/// is. Throws Error io when they differ.
MeshFacts check_mesh_file(const std::filesystem::path& path, MeshFormat format, const NumberedMesh& mesh,
                          MemoryBudget& budget, const Progress& progress);

}  // namespace ream::fe
