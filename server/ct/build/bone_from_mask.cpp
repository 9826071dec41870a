#include "ct/build/bone_from_mask.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "ct/build/surface_ramp.hpp"
#include "ct/hu_volume.hpp"
#include "ct/segment/voxel_window.hpp"
#include "voxel/bricks.hpp"
#include "voxel/upsample.hpp"

namespace ream::ct {
namespace {

constexpr double mg_per_g = 1000.0;
/// Width of the surface's ramp, in voxels of the bone. What is wider than one is felt early, by a quarter of
/// a voxel for 1.5; what is narrower shades in terraces. Of the scan's own voxels a little less than one, as
/// noise of a twentieth of bone's HU at its foot would be felt as bone.
constexpr double scan_ramp_voxels = 0.9, fine_ramp_voxels = 1.5;

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

void check_factor(int n) {
  if (n < 1 || n > voxel::max_upsample_factor)
    throw Error(ErrorKind::invalid_input, "upsampling factor " + std::to_string(n) + " must be from 1 to 16");
}

void check_size(const Vec3i& dims, int n) {
  constexpr double max_grid_voxels = 1.5e9;  // more than 3 GB of density and coverage
  if (dims.cast<double>().prod() * n * n * n > max_grid_voxels)
    throw Error(ErrorKind::invalid_input, "upsampling by " + std::to_string(n) +
                                              " makes more than 1.5e9 voxels; choose a smaller region of "
                                              "interest or a smaller factor");
}

/// Both upsampled and padded to whole bricks.
voxel::BoneModel upsampled(const HuVolume& volume, SurfaceVoxels surface, int n,
                           const case_::Calibration& calibration, const Progress& progress) {
  Vec3i to = volume.dims;
  for (int axis = 0; axis < 3; ++axis)
    while (to[axis] * n % voxel::brick_edge != 0) ++to[axis];
  surface.coverage = padded(surface.coverage, volume.dims, to);
  surface.bone_hu = padded(surface.bone_hu, volume.dims, to);

  voxel::BoneModel bone;
  bone.grid.dims = to * n;
  bone.grid.spacing_mm = volume.spacing_mm / n;
  bone.grid.world_from_grid = volume.world_from_volume;
  voxel::validate(bone.grid);
  progress(0.1, "upsampling the surface");
  std::vector<uint8_t> coverage =
      voxel::upsample_trilinear(std::span<const uint8_t>(surface.coverage), to, n);
  redraw_surface_ramp(bone.grid, n > 1 ? fine_ramp_voxels : scan_ramp_voxels, coverage);
  bone.coverage = voxel::bricks_from_rows(bone.grid, coverage);
  progress(0.4, "upsampling the density");
  bone.density = voxel::bricks_from_rows(
      bone.grid, density_codes(voxel::upsample_trilinear(std::span<const int16_t>(surface.bone_hu), to, n),
                               calibration));
  progress(1.0, "bone ready");
  return bone;
}

/// The voxels that a world box touches, as far as the volume goes.
VoxelWindow window_of_box(const HuVolume& volume, const Aabb& box_mm) {
  const Aabb box = box_mm.transformed(volume.world_from_volume.inverse());
  const auto voxel = [&](const Vec3& p) { return (p.array() / volume.spacing_mm.array()).eval(); };
  const Vec3 last = volume.dims.cast<double>();
  const Vec3i low = voxel(box.min).floor().matrix().cwiseMax(0.0).cwiseMin(last).cast<int>(),
              high = voxel(box.max).ceil().matrix().cwiseMax(0.0).cwiseMin(last).cast<int>();
  return {low, high - low};
}

void empty_border(std::vector<uint8_t>& coverage, const Vec3i& dims) {
  size_t i = 0;
  for (int w = 0; w < dims.z(); ++w)
    for (int v = 0; v < dims.y(); ++v)
      for (int u = 0; u < dims.x(); ++u, ++i)
        if (u == 0 || v == 0 || w == 0 || u + 1 == dims.x() || v + 1 == dims.y() || w + 1 == dims.z())
          coverage[i] = 0;
}

}  // namespace

double apparent_density_g_cc(double hu, const case_::Calibration& calibration) {
  const double qct = (calibration.intercept_mg_cc + calibration.slope_mg_cc_per_hu * hu) / mg_per_g;
  const double ash = calibration.ash_intercept_g_cc + calibration.ash_slope * qct;
  return std::max(0.0, ash / calibration.ash_per_apparent);
}

double hu_of_apparent_density(double density_g_cc, const case_::Calibration& calibration) {
  const double ash = density_g_cc * calibration.ash_per_apparent;
  const double qct = (ash - calibration.ash_intercept_g_cc) / calibration.ash_slope;
  return (qct * mg_per_g - calibration.intercept_mg_cc) / calibration.slope_mg_cc_per_hu;
}

voxel::BoneModel bone_of_whole_volume(const HuVolume& volume, Mask mask, int upsample,
                                      const case_::Calibration& calibration) {
  if (count_set(mask) == 0) throw Error(ErrorKind::invalid_input, "the segmentation holds no bone");
  check_factor(upsample);
  check_size(volume.dims, upsample);
  fill_voids(mask, volume.dims);
  return upsampled(volume, resolve_surface(volume, mask), upsample, calibration, no_progress);
}

voxel::BoneModel bone_from_mask(const HuVolume& volume, const Mask& mask, const BoneSettings& settings,
                                const Progress& progress) {
  check_factor(settings.upsample);
  progress(0.0, "cutting out the bone");
  const VoxelWindow around = window_of_set(mask, volume.dims);
  if (around.dims.isZero()) throw Error(ErrorKind::invalid_input, "the segmentation holds no bone");
  Mask whole = cut_out(mask, volume.dims, around);
  fill_voids(whole, around.dims);
  // The voxels just outside the mask are partly bone, too.
  VoxelWindow kept{around.low - Vec3i::Ones(), around.dims + Vec3i::Constant(2)};
  if (settings.roi_mm) kept = common(kept, window_of_box(volume, *settings.roi_mm));
  if ((kept.dims.array() <= 0).any())
    throw Error(ErrorKind::invalid_input, "the region of interest holds no bone; move it over the glenoid");
  check_size(kept.dims, settings.upsample);
  // One voxel beyond the region tells what the surface is, then is emptied to close it.
  const VoxelWindow wide{kept.low - Vec3i::Ones(), kept.dims + Vec3i::Constant(2)};
  HuVolume part;
  part.dims = wide.dims;
  part.spacing_mm = volume.spacing_mm;
  part.world_from_volume = volume.world_from_volume;
  part.world_from_volume.translation_mm +=
      volume.world_from_volume.direction(wide.low.cast<double>().cwiseProduct(volume.spacing_mm));
  part.hu.assign(part.voxel_count(), static_cast<int16_t>(soft_tissue_hu));
  Mask part_mask(part.voxel_count());
  copy_common(volume.hu, {Vec3i::Zero(), volume.dims}, part.hu, wide);
  copy_common(whole, around, part_mask, wide);
  progress(0.2, "resolving the surface");
  SurfaceVoxels surface = resolve_surface(part, part_mask);
  empty_border(surface.coverage, part.dims);
  if (std::none_of(surface.coverage.begin(), surface.coverage.end(), [](uint8_t c) { return c >= 128; }))
    throw Error(ErrorKind::invalid_input, "the region of interest holds no bone; move it over the glenoid");
  return upsampled(part, std::move(surface), settings.upsample, settings.calibration,
                   part_of(progress, 0.4, 1.0));
}

Aabb glenoid_roi_mm(const Vec3& centre_mm, const Vec3& lateral) {
  constexpr double medial_mm = 15.0;
  const Vec3 half_mm(30.0, 30.0, 35.0);
  const Vec3 middle = centre_mm - medial_mm * lateral.normalized();
  return {middle - half_mm, middle + half_mm};
}

std::array<double, 2> density_range_g_cc(const voxel::BoneModel& bone) {
  uint8_t least = voxel::cartilage_code, greatest = 0;
  for (size_t i = 0; i < bone.coverage.size(); ++i) {
    if (bone.coverage[i] < 128 || bone.density[i] == voxel::cartilage_code) continue;
    least = std::min(least, bone.density[i]);
    greatest = std::max(greatest, bone.density[i]);
  }
  if (least > greatest) return {0.0, 0.0};
  return {voxel::density_g_cc(least), voxel::density_g_cc(greatest)};
}

}  // namespace ream::ct
