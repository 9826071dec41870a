#pragma once
#include <optional>

#include "core/file_in_progress.hpp"
#include "core/progress.hpp"
#include "fe/compression.hpp"
#include "fe/element_model.hpp"
#include "fe/materials.hpp"
#include "fe/memory_budget.hpp"

namespace ream::fe {

struct InpOptions {
  std::optional<Compression> compression;  ///< with the node sets it needs
  bool faces = false;                      ///< node sets on the six faces
};

/// A mesh that is numbered and has its materials.
struct NumberedMesh {
  const ElementModel& model;
  const NodeNumbering& numbering;
  const Materials& materials;
  const MaterialRule& rule;
};

/// Writes the mesh as an input file of Abaqus and CalculiX: nodes, C3D8 elements (thesis fig. 2.2: lower face
/// counter-clockwise seen from above, then the upper one), an element set, material and section for each
/// material, and what the options ask for. Units mm, N, MPa. Returns the number of bytes. On two threads.
/// Errors: io; what `progress` throws.
uint64_t write_inp(const NumberedMesh& mesh, const InpOptions& options, MemoryBudget& budget,
                   const FileInProgress& file, const Progress& progress);

}  // namespace ream::fe
