#pragma once

#include "fe/element_model.hpp"
#include "fe/mesh_writers.hpp"

namespace ream::fe {

enum class MeshFormat { inp, vtu };
/// By the ending of the name. Error usage for another one.
MeshFormat format_of(const std::filesystem::path& out);

struct MeshOptions {
  int upsample = 1;
  bool keep_islands = false;
  MaterialRule rule;
  InpOptions inp;
  bool check = false;  ///< read the file before it gets its name, and hold it against the voxels
};

/// What was made, and how long each phase took, ms.
struct MeshReport {
  uint64_t elements = 0, nodes = 0, bytes = 0;
  Vec3i dims = Vec3i::Zero();
  Vec3 spacing_mm = Vec3::Ones();
  ComponentCount components;
  std::vector<Material> materials;
  double volume_mm3 = 0.0, box_volume_mm3 = 0.0;  ///< of the elements; of the box around them
  double modulus_mean_mpa = 0.0;
  double components_ms = 0.0, upsample_ms = 0.0, materials_ms = 0.0, numbering_ms = 0.0, write_ms = 0.0,
         check_ms = 0.0;
};

/// Makes the mesh of a model and writes it, whole or not at all. Errors: invalid_input for a model without an
/// element and those of materials and numbering; io; what `progress` throws.
MeshReport make_mesh(ElementModel model, const MeshOptions& options, MemoryBudget& budget,
                     const std::filesystem::path& out, const Progress& progress = no_progress);

}  // namespace ream::fe
