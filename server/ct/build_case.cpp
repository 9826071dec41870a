#include "ct/build_case.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "ct/calibration.hpp"
#include "voxel/brick_order.hpp"
#include "voxel/upsample.hpp"

namespace ream::ct {
namespace {

constexpr double seed_reach_mm = 2.0;

std::string text(const Vec3& p) {
  const auto one = [](double v) {
    std::string s = std::to_string(v);
    return s.substr(0, s.find('.') + 2);
  };
  return one(p.x()) + "," + one(p.y()) + "," + one(p.z());
}

/// Calls visit(u, v, w) for the voxels of the 3x3x3 around (u,v,w) that lie in the volume, without itself.
template <typename Visit>
void each_neighbour(const Vec3i& dims, int u, int v, int w, Visit&& visit) {
  for (int k = std::max(0, w - 1); k <= std::min(dims.z() - 1, w + 1); ++k)
    for (int j = std::max(0, v - 1); j <= std::min(dims.y() - 1, v + 1); ++j)
      for (int i = std::max(0, u - 1); i <= std::min(dims.x() - 1, u + 1); ++i)
        if (i != u || j != v || k != w) visit(i, j, k);
}

/// How full each voxel of the surface is, 0 to 255, and the HU of the bone in it.
struct SurfaceVoxels {
  std::vector<uint8_t> coverage;
  std::vector<int16_t> bone_hu;
};

uint8_t partial_volume(int hu, int bone_hu) {
  const double full = std::max(1.0, bone_hu - soft_tissue_hu);
  return static_cast<uint8_t>(std::clamp(std::floor(255.0 * (hu - soft_tissue_hu) / full + 0.5), 0.0, 255.0));
}

SurfaceVoxels resolve_surface(const HuVolume& volume, const Mask& mask) {
  constexpr uint8_t just_outside = 127;
  SurfaceVoxels result{std::vector<uint8_t>(mask.size()), volume.hu};
  for (int w = 0; w < volume.dims.z(); ++w)
    for (int v = 0; v < volume.dims.y(); ++v)
      for (int u = 0; u < volume.dims.x(); ++u) {
        const size_t here = volume.index(u, v, w);
        bool at_surface = false;
        int densest = mask[here] ? volume.hu[here] : -32768;
        each_neighbour(volume.dims, u, v, w, [&](int i, int j, int k) {
          const size_t n = volume.index(i, j, k);
          at_surface = at_surface || mask[n] != mask[here];
          if (mask[n]) densest = std::max<int>(densest, volume.hu[n]);
        });
        if (!at_surface) {
          result.coverage[here] = mask[here] ? 255 : 0;
          continue;
        }
        const uint8_t fill = partial_volume(volume.hu[here], densest);
        result.coverage[here] = mask[here] ? fill : std::min(fill, just_outside);
        result.bone_hu[here] = static_cast<int16_t>(densest);
      }
  return result;
}

/// The volume of `dims` in the low corner of one of dims `to`; the rest is zero.
template <typename T>
std::vector<T> padded(const std::vector<T>& data, const Vec3i& dims, const Vec3i& to) {
  if (dims == to) return data;
  std::vector<T> result(static_cast<size_t>(to.x()) * static_cast<size_t>(to.y()) *
                        static_cast<size_t>(to.z()));
  size_t source = 0;
  for (int w = 0; w < dims.z(); ++w)
    for (int v = 0; v < dims.y(); ++v) {
      const size_t row = static_cast<size_t>(to.x()) *
                         (static_cast<size_t>(v) + static_cast<size_t>(to.y()) * static_cast<size_t>(w));
      std::copy_n(data.begin() + static_cast<std::ptrdiff_t>(source), dims.x(),
                  result.begin() + static_cast<std::ptrdiff_t>(row));
      source += static_cast<size_t>(dims.x());
    }
  return result;
}

std::vector<uint8_t> density_codes(const std::vector<int16_t>& hu, const case_::Calibration& calibration) {
  std::vector<uint8_t> code_of_hu(65536);
  for (int h = -32768; h <= 32767; ++h)
    code_of_hu[static_cast<size_t>(h + 32768)] = voxel::density_code(apparent_density_g_cc(h, calibration));
  std::vector<uint8_t> codes(hu.size());
  for (size_t i = 0; i < hu.size(); ++i) codes[i] = code_of_hu[static_cast<size_t>(hu[i] + 32768)];
  return codes;
}

}  // namespace

Mask segment(HuVolume& volume, const SegmentationOptions& options) {
  smooth(volume, options.sigma_mm);
  Mask mask = above_threshold(volume, options.threshold_hu);
  if (count_set(mask) == 0)
    throw Error(ErrorKind::invalid_input,
                "no voxel reaches the threshold of " + std::to_string(std::lround(options.threshold_hu)) +
                    " HU (the highest is " +
                    std::to_string(*std::max_element(volume.hu.begin(), volume.hu.end())) +
                    "); lower --threshold-hu or choose another region");
  if (!options.grow_from_mm) return largest_part(mask, volume.dims);
  const auto seed = nearest_set(mask, volume, *options.grow_from_mm, seed_reach_mm);
  if (!seed)
    throw Error(ErrorKind::invalid_input,
                "no bone within 2 mm of the seed " + text(*options.grow_from_mm) +
                    " mm; give --grow-from a point in the bone (LPS) or lower --threshold-hu");
  return grown_from(mask, volume.dims, *seed);
}

voxel::BoneModel bone_from_mask(const HuVolume& volume, Mask mask, const SegmentationOptions& options) {
  if (count_set(mask) == 0) throw Error(ErrorKind::invalid_input, "the segmentation holds no bone");
  fill_voids(mask, volume.dims);
  const int n = options.upsample;
  if (n < 1 || n > voxel::max_upsample_factor)
    throw Error(ErrorKind::invalid_input, "upsampling factor " + std::to_string(n) + " must be from 1 to 16");
  Vec3i to = volume.dims;
  for (int axis = 0; axis < 3; ++axis)
    while (to[axis] * n % voxel::brick_edge != 0) ++to[axis];
  SurfaceVoxels surface = resolve_surface(volume, mask);
  surface.coverage = padded(surface.coverage, volume.dims, to);
  surface.bone_hu = padded(surface.bone_hu, volume.dims, to);

  voxel::BoneModel bone;
  bone.grid.dims = to * n;
  bone.grid.spacing_mm = volume.spacing_mm / n;
  bone.grid.world_from_grid = volume.world_from_volume;
  voxel::validate(bone.grid);
  bone.coverage = voxel::bricks_from_rows(
      bone.grid, voxel::upsample_trilinear(std::span<const uint8_t>(surface.coverage), to, n));
  bone.density = voxel::bricks_from_rows(
      bone.grid, density_codes(voxel::upsample_trilinear(std::span<const int16_t>(surface.bone_hu), to, n),
                               options.calibration));
  return bone;
}

}  // namespace ream::ct
