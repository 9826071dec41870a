#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include "bench/baselines/layout.h"
#include "bench/baselines/voxmap.hpp"
#include "gpu/program.hpp"
#include "shell/point_shell.hpp"

namespace ream::bench {

/// The shell as the thesis stores it: one 32-bit Morton code a point (section 4.3).
struct MortonShell {
  std::vector<uint32_t> codes;
  Vec3f origin_mm = Vec3f::Zero();  ///< minimum corner of cell (0,0,0), tool frame
  float spacing_mm = 0.0f;
  Aabb box_mm;  ///< around the cells, tool frame

  /// Cell centre in floats, as every baseline reckons it.
  Vec3f point_mm(uint32_t code) const;
};

/// Throws Error invalid_input for a shell of more than 1024 cells a side, where the thesis' codes end.
MortonShell morton_shell(const shell::PointShell& shell);

struct FlatOptions {
  bool use_voi = true;
  uint8_t decay = 0;  ///< gray levels that each point takes from its voxel (algorithm 4.1); 0: contact alone
};

/// Elemental forces summed as integers, and how many points are inside.
struct FlatSums {
  std::array<int32_t, 3> force{};
  int32_t inside = 0;
  bool operator==(const FlatSums&) const = default;
};

/// The thesis' broad phase: boxes around bone and tool by the separating-axis test, then the bone's box seen
/// from the tool cut with the tool's own (section 4.4). Empty when they do not meet.
Aabb thesis_voi(const Aabb& bone_box_mm, const Aabb& tool_box_mm, const Pose& grid_from_tool);

/// The thesis' contact kernel (sections 4.4 and 4.5) on an OpenCL device, broad phase included. The thesis
/// leaves open where an elemental force points; here it is towards the middle of the tool, in proportion to
/// the gray value.
class FlatKernel {
 public:
  /// `voxmap` and `shell` must outlive it; on devices that share memory the kernel works on them directly.
  FlatKernel(const gpu::Queue& queue, Voxmap& voxmap, const MortonShell& shell);
  FlatSums contact(const QuantisedPose& grid_from_tool, const FlatOptions& options = {});

 private:
  const gpu::Queue& queue_;
  Voxmap& voxmap_;
  const MortonShell& shell_;
  gpu::Program program_;
  gpu::Kernel kernel_;
  gpu::Buffer codes_, gray_, exchange_;
};

/// The same sums as a fair CPU form has them: coordinates decoded once, no branches, so that the compiler can
/// work on many points at once, and on two threads. The second one spins between poses, and sleeps
/// when none comes, so that it takes no processor from others. Contact alone.
class FlatThreads {
 public:
  /// `voxmap` and `shell` must outlive it.
  FlatThreads(const Voxmap& voxmap, const MortonShell& shell);
  ~FlatThreads();
  FlatThreads(const FlatThreads&) = delete;
  FlatThreads& operator=(const FlatThreads&) = delete;
  FlatSums contact(const QuantisedPose& grid_from_tool);

 private:
  void second_thread();

  const Voxmap& voxmap_;
  const MortonShell& shell_;
  std::vector<float> x_, y_, z_;
  layout::FlatExchange exchange_{};
  FlatSums second_sums_;
  std::atomic<uint32_t> asked_{0}, answered_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

/// The same sums in plain C++ on one thread. `inside`, when given, gets one byte a point: 1 where it is in
/// bone.
FlatSums flat_contact_cpu(Voxmap& voxmap, const MortonShell& shell, const QuantisedPose& grid_from_tool,
                          const FlatOptions& options = {}, std::vector<uint8_t>* inside = nullptr);

}  // namespace ream::bench
