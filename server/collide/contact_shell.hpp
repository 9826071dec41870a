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
  /// Probes, tool frame, mm. Cutting points probe one voxel out from the true surface along the normal
  /// (DESIGN 3: engaged when bone lies within one voxel, for removal must not clear its own contact). Guiding
  /// points have no such need and probe one voxel below the surface, end faces also two nearer to the axis:
  /// corners of voxels, which stand out by up to 0.87 edges, shall not stop a nipple at the mouth of a hole
  /// that is barely wider, and its side meets the wall of the hole before its end does.
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
