#include "collide/removal/decay.hpp"

#include <algorithm>

#include "core/hash.hpp"
#include "core/vector_clones.hpp"

namespace ream::collide {
namespace {

DecayRun run_of(const DecayShell& shell, uint32_t first, uint32_t count) {
  const auto point = [&](uint32_t i) { return Vec3f(shell.x_mm[i], shell.y_mm[i], shell.z_mm[i]); };
  Vec3f low = point(first), high = low;
  for (uint32_t i = first; i < first + count; ++i) {
    low = low.cwiseMin(point(i));
    high = high.cwiseMax(point(i));
  }
  DecayRun run{first, count, 0.5f * (low + high), 0.0f};
  for (uint32_t i = first; i < first + count; ++i)
    run.radius_mm = std::max(run.radius_mm, (point(i) - run.centre_mm).norm());
  return run;
}

/// Covers rounding in the place of a run's sphere, voxels.
constexpr float slack_voxels = 1.0f;

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

DecayShell make_decay_shell(const shell::PointShell& shell) {
  DecayShell out;
  for (const shell::ShellPoint& p : shell.points) {
    if (p.role != shell::SurfaceRole::cutting) continue;
    const Vec3 at = shell.surface_point_mm(p);
    out.x_mm.push_back(static_cast<float>(at.x()));
    out.y_mm.push_back(static_cast<float>(at.y()));
    out.z_mm.push_back(static_cast<float>(at.z()));
  }
  const auto size = static_cast<uint32_t>(out.size());
  for (uint32_t first = 0; first < size; first += decay_run_points)
    out.runs.push_back(run_of(out, first, std::min(decay_run_points, size - first)));
  return out;
}

Decay::Decay(const DecayInput& input)
    : in_(input),
      classes_(voxel::class_table(input.bone.cortical_threshold_g_cc)),
      runs_(input.shell.runs.size()),
      changed_(std::min(input.shell.size(), input.bone.grid.brick_count())),
      is_changed_((input.bone.grid.brick_count() + 7) / 8) {
  Vec3i low = input.bone.grid.dims, high = Vec3i::Zero();
  for (size_t i = 0; i < input.bone.coverage.size(); ++i) {
    if (input.bone.coverage[i] == 0) continue;
    const Vec3i at = input.bone.grid.coordinates(i);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at + Vec3i::Ones());
  }
  bone_low_ = low.cast<float>();
  bone_high_ = high.cast<float>();
}

bool Decay::apply(const QuantisedPose& grid_from_tool, RemovalSums& sums) noexcept {
  sums = {};
  changed_count_ = 0;
  const GridAffine affine = voxel_from_tool(grid_from_tool, in_.bone.grid);
  const Hits hits = find_hits(affine, runs_near_bone(affine));
  if (!hits.ok) return false;
  for (const uint32_t voxel : hits.voxels)
    if (voxel != no_voxel) lower(voxel, sums);
  sums.changed_bricks = static_cast<uint32_t>(changed_count_);
  for (const uint32_t brick : changed_bricks()) is_changed_[brick / 8] = 0;
  return true;
}

std::span<const uint32_t> Decay::runs_near_bone(const GridAffine& a) noexcept {
  const float voxels_per_mm = static_cast<float>(1.0 / in_.bone.grid.min_spacing_mm());
  size_t n = 0;
  for (uint32_t i = 0; i < runs_.size(); ++i) {
    const DecayRun& run = in_.shell.runs[i];
    const float reach = run.radius_mm * voxels_per_mm + slack_voxels;
    bool near = true;
    for (int k = 0; k < 3; ++k) {
      const float at = a.m[3 * k] * run.centre_mm.x() + a.m[3 * k + 1] * run.centre_mm.y() +
                       a.m[3 * k + 2] * run.centre_mm.z() + a.t[k];
      near = near && at + reach >= bone_low_[k] && at - reach <= bone_high_[k];
    }
    if (near) runs_[n++] = i;
  }
  return {runs_.data(), n};
}

/// The hash's terms telescope: what all steps of a voxel add is its last state less its first.
void Decay::lower(uint32_t voxel, RemovalSums& sums) noexcept {
  uint8_t& coverage = in_.bone.coverage[voxel];
  if (coverage == 0) return;
  const int left = std::max(0, coverage - in_.levels);
  sums.coverage_removed[static_cast<size_t>(classes_[in_.bone.density[voxel]])] += coverage - left;
  sums.change_hash +=
      mix64(change_key(voxel, static_cast<uint8_t>(left))) - mix64(change_key(voxel, coverage));
  coverage = static_cast<uint8_t>(left);
  const uint32_t brick = voxel / voxel::brick_voxels;
  const auto bit = static_cast<uint8_t>(1u << (brick % 8));
  if (is_changed_[brick / 8] & bit) return;
  is_changed_[brick / 8] |= bit;
  changed_[changed_count_++] = brick;
}

std::unique_ptr<Decay> make_decay_cpu(const DecayInput& input) { return std::make_unique<DecayCpu>(input); }

}  // namespace ream::collide
