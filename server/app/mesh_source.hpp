#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "core/memory_budget.hpp"
#include "core/progress.hpp"
#include "fe/element_model.hpp"

namespace ream::app {

/// What a mesh is to be made of.
struct MeshSource {
  /// A volume (folder, file or zip, as ct::read_ct), text rows, a case, or a recorded session; cases and
  /// sessions by path or, where there is no such path, by id.
  std::string name;
  std::string case_name;  ///< of a session, where its case is not in the data folder
  /// Least gray value (of volumes and rows) or density (of cases and sessions, g/cc) that is bone; without it
  /// volumes are bone above 0, rows and cases where they say so.
  std::optional<double> threshold;
  std::filesystem::path data;
};

/// Voxels of bone with their gray values. Of a case the bone as it is before reaming, its pilot hole not cut;
/// of a session what it left. Cartilage is no bone. Errors: not_found, invalid_input, those of recordings.
fe::ElementModel open_mesh_source(const MeshSource& source, MemoryBudget& budget,
                                  const Progress& progress = no_progress);

}  // namespace ream::app
