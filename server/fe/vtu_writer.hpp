#pragma once
#include "fe/inp_writer.hpp"

namespace ream::fe {

/// Writes the mesh as an unstructured grid of VTK, hexahedra with appended raw data in this machine's byte
/// order; of each cell `gray`, `modulus_MPa` and `material` (its number in the .inp file). Points are in mm
/// of the mesh frame, 64 bit. Returns the number of bytes. On two threads. Errors: io; what `progress`
/// throws.
uint64_t write_vtu(const NumberedMesh& mesh, const FileInProgress& file, const Progress& progress);

}  // namespace ream::fe
