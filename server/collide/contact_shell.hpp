#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "shell/point_shell.hpp"

namespace ream::collide {

/// Components a contact point adds to the sums: unit normal n and moment arm (r x n)/moment_length, each in
/// 1/127, then 1 (so that first moments fall out of the same products), then padding.
using ContactVector = std::array<int16_t, 8>;

/// A PointShell made ready for one grid: where each point probes for bone and what it adds when it meets
/// some. Struct of arrays in shell order, shared by all narrow phases.
struct ContactShell {
  /// Probes, tool frame, mm: one voxel out from the true surface along the normal (DESIGN 3: a point is
  /// engaged when bone lies within one voxel, for removal must not clear its own contact).
  std::vector<float> probe_x_mm, probe_y_mm, probe_z_mm;
  std::vector<ContactVector> vectors;
  std::vector<uint8_t> weights;           ///< area in 1/16 cell face
  std::vector<uint8_t> guiding;           ///< 1: guiding or smooth surface, which never cuts
  std::vector<shell::ShellBlock> blocks;  ///< spheres grown to hold the probes
  double moment_length_mm = 1.0;
  double cell_area_mm2 = 0.0;
  double probe_length_mm = 0.0;
  Aabb bounds_mm;

  size_t size() const { return probe_x_mm.size(); }
};

/// `probe_length_mm`: the grid's largest voxel edge.
ContactShell make_contact_shell(const shell::PointShell& shell, double probe_length_mm);

}  // namespace ream::collide
