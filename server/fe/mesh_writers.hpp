#pragma once
#include <optional>
#include <string>

#include "core/atomic_file.hpp"
#include "core/memory_budget.hpp"
#include "core/progress.hpp"
#include "fe/element_model.hpp"
#include "fe/materials.hpp"
#include "fe/node_numbering.hpp"

namespace ream::fe {

/// A ready test of uniaxial compression between the two faces of an axis.
struct Compression {
  int axis = 2;          ///< 0, 1, 2: x, y, z
  double strain = 0.01;  ///< of the height between the faces
  /// Nodes on the platens keep their place across the axis; else they slide without friction.
  bool fixed_platens = false;
};

/// How far the greatest face moves towards the least, mm.
double compression_mm(const Compression& compression, const NodeNumbering& numbering, const Vec3& spacing_mm);

/// Boundaries and the step, as Abaqus and CalculiX take them, for the node sets of face_names. Where platens
/// slide, one node of the least face is held across the axis and a second one against turning about it, which
/// strains nothing.
std::string compression_text(const Compression& compression, const NodeNumbering& numbering,
                             const Vec3& spacing_mm);

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
                   const AtomicFile& file, const Progress& progress);

/// Writes the mesh as an unstructured grid of VTK, hexahedra with appended raw data in this machine's byte
/// order; of each cell `gray`, `modulus_MPa` and `material` (its number in the .inp file). Points are in mm
/// of the mesh frame, 64 bit. Returns the number of bytes. On two threads. Errors: io; what `progress`
/// throws.
uint64_t write_vtu(const NumberedMesh& mesh, const AtomicFile& file, const Progress& progress);

}  // namespace ream::fe
