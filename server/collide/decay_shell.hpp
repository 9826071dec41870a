#pragma once
#include <cstdint>
#include <vector>

#include "shell/point_shell.hpp"

namespace ream::collide {

/// Consecutive points of a DecayShell, near each other.
struct DecayRun {
  uint32_t first = 0, count = 0;
  Vec3f centre_mm = Vec3f::Zero();  ///< bounding sphere, tool frame
  float radius_mm = 0;
};

/// Points a run may have at most.
inline constexpr uint32_t decay_run_points = 256;

/// The cutting points of a PointShell, where they lie on the true surface, tool frame, mm: what algorithm 4.1
/// removes bone with. Made only for sessions that remove by decay; 12 bytes a point.
struct DecayShell {
  std::vector<float> x_mm, y_mm, z_mm;  ///< Morton order
  std::vector<DecayRun> runs;

  size_t size() const { return x_mm.size(); }
};

DecayShell make_decay_shell(const shell::PointShell& shell);

}  // namespace ream::collide
