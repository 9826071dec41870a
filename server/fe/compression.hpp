#pragma once
#include <string>

#include "fe/mesh_faces.hpp"

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

}  // namespace ream::fe
