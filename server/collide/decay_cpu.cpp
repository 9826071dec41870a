#include "collide/decay.hpp"
#include "core/vector_clones.hpp"

namespace ream::collide {
namespace {

/// Voxels of a run's points, in memory order, `outside` for points outside the grid. Straight-line
/// arithmetic, so that it vectorizes; the order of operations is that of kernels/decay.cl.
REAM_VECTOR_CLONES void find_voxels(const float* __restrict x, const float* __restrict y,
                                    const float* __restrict z, int n, const GridAffine& shared_affine,
                                    const Vec3i& dims, uint32_t outside, uint32_t* __restrict voxels) {
  const GridAffine a = shared_affine;
  const float du = static_cast<float>(dims.x()), dv = static_cast<float>(dims.y()),
              dw = static_cast<float>(dims.z());
  const int brick_row = dims.x() / 8, brick_slice = brick_row * (dims.y() / 8);
  for (int i = 0; i < n; ++i) {
    const float u = a.m[0] * x[i] + a.m[1] * y[i] + a.m[2] * z[i] + a.t[0];
    const float v = a.m[3] * x[i] + a.m[4] * y[i] + a.m[5] * z[i] + a.t[1];
    const float w = a.m[6] * x[i] + a.m[7] * y[i] + a.m[8] * z[i] + a.t[2];
    const int inside = (u >= 0.0f ? 1 : 0) & (v >= 0.0f ? 1 : 0) & (w >= 0.0f ? 1 : 0) & (u < du ? 1 : 0) &
                       (v < dv ? 1 : 0) & (w < dw ? 1 : 0);
    const int iu = static_cast<int>(inside ? u : 0.0f), iv = static_cast<int>(inside ? v : 0.0f),
              iw = static_cast<int>(inside ? w : 0.0f);
    const int brick = (iu >> 3) + (iv >> 3) * brick_row + (iw >> 3) * brick_slice;
    const int voxel = brick * 512 + (iu & 7) + (iv & 7) * 8 + (iw & 7) * 64;
    voxels[i] = inside ? static_cast<uint32_t>(voxel) : outside;
  }
}

class DecayCpu final : public Decay {
 public:
  explicit DecayCpu(const DecayInput& input) : Decay(input), hits_(input.shell.size()) {}

 private:
  Hits find_hits(const GridAffine& voxel_from_tool, std::span<const uint32_t> runs) noexcept override {
    const DecayShell& shell = in_.shell;
    size_t count = 0;
    for (const uint32_t number : runs) {
      const DecayRun& run = shell.runs[number];
      uint32_t voxels[decay_run_points];
      find_voxels(shell.x_mm.data() + run.first, shell.y_mm.data() + run.first, shell.z_mm.data() + run.first,
                  static_cast<int>(run.count), voxel_from_tool, in_.bone.grid.dims, no_voxel, voxels);
      for (uint32_t i = 0; i < run.count; ++i) {
        hits_[count] = voxels[i];
        count += voxels[i] != no_voxel && in_.bone.coverage[voxels[i]] != 0;
      }
    }
    return {{hits_.data(), count}, true};
  }

  std::vector<uint32_t> hits_;
};

}  // namespace

std::unique_ptr<Decay> make_decay_cpu(const DecayInput& input) { return std::make_unique<DecayCpu>(input); }

}  // namespace ream::collide
