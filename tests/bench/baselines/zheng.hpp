#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "bench/baselines/flat_kernel.hpp"

namespace ream::bench {

/// The method of Zheng et al. as far as thesis 1.6.3 and 4.6.3 describe it: points as three floats; a voxel
/// as a float gray value and a flag that says whether it is collided (5 bytes, here in two arrays); each
/// point's voxel found by dividing the grid from the top down; forces of all points written apart and added
/// by a parallel reduction. No volume of interest.
class Zheng {
 public:
  /// The thesis stops at 512^3: 1024^3 voxels of 5 bytes are 5.4 GB, and the gray values alone are more than
  /// a device gives in one buffer.
  static constexpr int largest_resolution = 512;
  static constexpr size_t voxel_bytes = 5, point_bytes = 12;

  Zheng(const gpu::Queue& queue, const Voxmap& voxmap, const MortonShell& shell);

  struct Sums {
    std::array<float, 3> force{};
    int64_t inside = 0;
  };
  /// With `clear_flags` the flags of the whole grid are reset first. The thesis does not say that it did so,
  /// but its times grow with the number of voxels, as only this step does.
  Sums contact(const QuantisedPose& grid_from_tool, bool clear_flags);

  /// One byte a point of the last contact: 1 where it is in bone.
  std::vector<uint8_t> inside() const;
  /// Number of flagged voxels.
  int64_t collided_voxels() const;

 private:
  using Force = std::array<float, 4>;  ///< and 1 for a point that is inside

  const gpu::Queue& queue_;
  voxel::VoxelGrid grid_;
  size_t point_count_ = 0;
  layout::ZhengArguments arguments_{};
  gpu::Program program_;
  gpu::Kernel find_;
  gpu::Kernel reduce_;
  gpu::Buffer points_, gray_, collided_, argument_buffer_;
  gpu::Buffer forces_;
  std::array<gpu::Buffer, 2> partial_;
};

}  // namespace ream::bench
