#include <algorithm>
#include <cstring>

#include "collide/narrow_phase.hpp"

namespace ream::collide {
namespace {

constexpr size_t max_block_points = 512;

/// Voxel index of each probe, or -1 outside the grid. Kept apart from the look-ups so that it vectorizes; the
/// order of operations is that of kernels/narrow_phase.cl.
__attribute__((target_clones("avx512f", "avx2", "default"))) void probe_voxels(
    const float* x, const float* y, const float* z, size_t n, const GridAffine& a, const Vec3i& dims, int64_t* index) {
  const float dx = static_cast<float>(dims.x()), dy = static_cast<float>(dims.y()), dz = static_cast<float>(dims.z());
  const int64_t row = dims.x(), slice = row * dims.y();
  for (size_t i = 0; i < n; ++i) {
    const float u = a.m[0] * x[i] + a.m[1] * y[i] + a.m[2] * z[i] + a.t[0];
    const float v = a.m[3] * x[i] + a.m[4] * y[i] + a.m[5] * z[i] + a.t[1];
    const float w = a.m[6] * x[i] + a.m[7] * y[i] + a.m[8] * z[i] + a.t[2];
    const bool inside = (u >= 0.0f) & (v >= 0.0f) & (w >= 0.0f) & (u < dx) & (v < dy) & (w < dz);
    const int64_t at = static_cast<int64_t>(static_cast<int>(inside ? u : 0.0f)) +
                       static_cast<int64_t>(static_cast<int>(inside ? v : 0.0f)) * row +
                       static_cast<int64_t>(static_cast<int>(inside ? w : 0.0f)) * slice;
    index[i] = inside ? at : -1;
  }
}

/// Outer-product sums of one block; 512 points of weight 28 and components 127 stay below 2^31.
struct BlockSums {
  int32_t products[7][8] = {};
  int32_t points = 0;

  void add(const ContactVector& g, int32_t weight) {
    for (size_t i = 0; i < 7; ++i) {
      const int32_t wg = weight * g[i];
      for (size_t j = 0; j < 8; ++j) products[i][j] += wg * g[j];
    }
    ++points;
  }

  void add_to(ContactSums::Part& part) const {
    if (points == 0) return;
    part.points += points;
    for (size_t i = 0; i < 7; ++i) part.first[i] += products[6][i];
    size_t k = 0;
    for (size_t i = 0; i < 6; ++i)
      for (size_t j = i; j < 6; ++j) part.second[k++] += products[i][j];
  }
};

class NarrowPhaseCpu final : public NarrowPhase {
 public:
  explicit NarrowPhaseCpu(const NarrowPhaseInput& input)
      : in_(input), classes_(voxel::class_table(input.bone.cortical_threshold_g_cc)), survivors_(input.shell.blocks.size()) {}

  bool contact(const QuantisedPose& grid_from_tool, const Voi& voi, ContactSums& sums) noexcept override {
    sums = {};
    if (!voi.touching) return true;
    const GridAffine affine = voxel_from_tool(grid_from_tool, in_.bone.grid);
    const size_t n = cull_blocks(in_.shell, in_.distance, voi, affine,
                                 static_cast<float>(in_.bone.grid.min_spacing_mm()), survivors_);
    for (size_t i = 0; i < n; ++i) {
      const shell::ShellBlock& block = in_.shell.blocks[survivors_[i]];
      for (uint32_t done = 0; done < block.count; done += max_block_points)
        add_run(block.first + done, std::min<size_t>(block.count - done, max_block_points), affine, sums);
    }
    return true;
  }

 private:
  void add_run(size_t first, size_t count, const GridAffine& affine, ContactSums& sums) noexcept {
    int64_t index[max_block_points];
    const ContactShell& s = in_.shell;
    probe_voxels(s.probe_x_mm.data() + first, s.probe_y_mm.data() + first, s.probe_z_mm.data() + first, count, affine,
                 in_.bone.grid.dims, index);
    const uint8_t* coverage = in_.bone.coverage.data();
    const uint8_t* density = in_.bone.density.data();
    BlockSums cutting, guiding;
    for (size_t i = 0; i < count; ++i) {
      if (index[i] < 0 || coverage[index[i]] < engaging_coverage) continue;
      const size_t point = first + i;
      if (s.guiding[point]) {
        guiding.add(s.vectors[point], s.weights[point]);
        continue;
      }
      cutting.add(s.vectors[point], s.weights[point]);
      const uint8_t code = density[index[i]];
      const auto bone_class = static_cast<size_t>(classes_[code]);
      ++sums.class_points[bone_class];
      sums.class_density[bone_class] += code;
    }
    cutting.add_to(sums.cutting);
    guiding.add_to(sums.guiding);
  }

  NarrowPhaseInput in_;
  std::array<voxel::BoneClass, 256> classes_;
  std::vector<uint32_t> survivors_;
};

}  // namespace

std::unique_ptr<NarrowPhase> make_narrow_phase_cpu(const NarrowPhaseInput& input) {
  return std::make_unique<NarrowPhaseCpu>(input);
}

size_t cull_blocks(const ContactShell& shell, const voxel::BrickDistance& distance, const Voi& voi,
                   const GridAffine& a, float min_spacing_mm, std::span<uint32_t> survivors) noexcept {
  const Vec3f low = voi.box_tool_mm.min.cast<float>(), high = voi.box_tool_mm.max.cast<float>();
  const float voxels_per_mm = 1.0f / min_spacing_mm;
  size_t n = 0;
  for (uint32_t b = 0; b < shell.blocks.size(); ++b) {
    const auto& block = shell.blocks[b];
    const Vec3f& c = block.centre_mm;
    const float r = block.radius_mm;
    if (c.x() + r < low.x() || c.x() - r > high.x() || c.y() + r < low.y() || c.y() - r > high.y() ||
        c.z() + r < low.z() || c.z() - r > high.z())
      continue;
    const float u = a.m[0] * c.x() + a.m[1] * c.y() + a.m[2] * c.z() + a.t[0];
    const float v = a.m[3] * c.x() + a.m[4] * c.y() + a.m[5] * c.z() + a.t[1];
    const float w = a.m[6] * c.x() + a.m[7] * c.y() + a.m[8] * c.z() + a.t[2];
    // One voxel of slack covers rounding in the centre's coordinates.
    if (distance.lower_bound_voxels(u, v, w) > r * voxels_per_mm + 1.0f) continue;
    survivors[n++] = b;
  }
  return n;
}

}  // namespace ream::collide
