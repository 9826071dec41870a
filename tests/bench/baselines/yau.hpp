#pragma once
#include <cstdint>

#include "bench/baselines/layout.h"
#include "bench/baselines/voxmap.hpp"
#include "gpu/program.hpp"

namespace ream::bench {

/// What the cutting lips sweep, tool frame: the part of an ellipsoid of revolution with its tip at the
/// origin, semi-axes `across_mm` and `along_mm` (equal: a sphere), from the tip back to a plane `depth_mm`
/// behind it.
struct ImplicitCap {
  double across_mm = 0.0, along_mm = 0.0, depth_mm = 0.0;

  /// Box around it, tool frame.
  Aabb box_mm() const;
};

/// The method of Yau et al. as thesis 4.6.4 makes it parallel: the implicit cap in place of a PointShell and
/// one work-item per voxel of the volume of interest, which is given in voxels. Contact alone: nothing is
/// removed.
class Yau {
 public:
  struct Sums {
    int64_t collided = 0;         ///< filled voxels whose centre is in the cap
    int64_t gray_sixteenths = 0;  ///< their gray values, each divided by 16
    bool operator==(const Sums&) const = default;
  };

  /// `voxmap` must outlive it; on devices that share memory the kernel works on it directly.
  Yau(const gpu::Queue& queue, const Voxmap& voxmap, const ImplicitCap& cap);
  Sums contact(const QuantisedPose& grid_from_tool);

 private:
  const gpu::Queue& queue_;
  const Voxmap& voxmap_;
  ImplicitCap cap_;
  gpu::Program program_;
  gpu::Kernel kernel_;
  gpu::Buffer gray_, exchange_;
};

}  // namespace ream::bench
