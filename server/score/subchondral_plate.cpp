#include "score/subchondral_plate.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ream::score {
namespace {

constexpr double surface_layer_mm = 1.5, spongy_from_mm = 4.0, spongy_to_mm = 6.0, thickest_mm = 5.0;
constexpr double least_contrast_g_cc = 0.25;
constexpr double enough_share = 0.25;  // of the rays must show an end

/// Density of bone along a ray, sampled from the subchondral surface on.
class DensityProbe {
 public:
  DensityProbe(const voxel::BoneModel& bone, const RayLattice& rays)
      : bone_(bone), rays_(rays), grid_from_world_(bone.grid.world_from_grid.inverse()) {}

  /// Trilinear among voxels that are bone; empty where there is none.
  std::optional<double> at(size_t ray, double depth_mm) const {
    const Vec3 point = grid_from_world_.point(rays_.world(ray, depth_mm));
    const Vec3 position = (point.array() / bone_.grid.spacing_mm.array() - 0.5).matrix();
    const Vec3 low = position.array().floor().matrix(), t = position - low;
    const Vec3i base = low.cast<int>();
    double sum = 0.0, weights = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3i o(base.x() + (corner & 1), base.y() + ((corner >> 1) & 1), base.z() + (corner >> 2));
      if (!bone_.grid.contains(o)) continue;
      const size_t i = bone_.grid.index(o);
      if (bone_.coverage[i] == 0 || bone_.density[i] == voxel::cartilage_code) continue;
      const double weight = ((corner & 1) ? t.x() : 1.0 - t.x()) * ((corner & 2) ? t.y() : 1.0 - t.y()) *
                            ((corner & 4) ? t.z() : 1.0 - t.z());
      sum += weight * voxel::density_g_cc(bone_.density[i]);
      weights += weight;
    }
    return weights > 1e-6 ? std::optional(sum / weights) : std::nullopt;
  }

 private:
  const voxel::BoneModel& bone_;
  const RayLattice& rays_;
  Pose grid_from_world_;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Where density falls below `limit` for the first time after having been above it.
std::optional<double> end_of_plate(const DensityProbe& probe, size_t ray, double from_mm, double limit,
                                   double step_mm) {
  bool dense = false;
  double before = 0.0;
  for (double s = 0.5 * step_mm; s <= thickest_mm; s += step_mm) {
    const auto density = probe.at(ray, from_mm + s);
    if (!density) return std::nullopt;
    if (dense && *density < limit) return s - step_mm * (limit - *density) / (before - *density);
    if (!dense && s > surface_layer_mm) return std::nullopt;
    dense = dense || *density >= limit;
    before = *density;
  }
  return std::nullopt;
}

/// Medians over the face: the densest within the surface layer, and the mean further below.
std::optional<double> limit_density(const DensityProbe& probe, const std::vector<double>& subchondral_mm,
                                    const std::vector<uint8_t>& face, double step_mm) {
  std::vector<double> dense, spongy;
  for (size_t ray = 0; ray < face.size(); ++ray) {
    if (!face[ray]) continue;
    double densest = -1.0, sum = 0.0;
    int count = 0;
    for (double s = 0.5 * step_mm; s <= surface_layer_mm; s += step_mm)
      densest = std::max(densest, probe.at(ray, subchondral_mm[ray] + s).value_or(-1.0));
    for (double s = spongy_from_mm; s <= spongy_to_mm; s += step_mm)
      if (const auto density = probe.at(ray, subchondral_mm[ray] + s)) sum += *density, ++count;
    if (densest >= 0.0) dense.push_back(densest);
    if (count > 0) spongy.push_back(sum / count);
  }
  if (dense.empty() || spongy.empty()) return std::nullopt;
  const double above = median(std::move(dense)), below = median(std::move(spongy));
  return above - below >= least_contrast_g_cc ? std::optional(0.5 * (above + below)) : std::nullopt;
}

}  // namespace

SubchondralPlate find_plate(const voxel::BoneModel& bone, const RayLattice& rays,
                            const std::vector<double>& subchondral_mm, const std::vector<uint8_t>& face) {
  SubchondralPlate plate;
  plate.thickness_mm.assign(rays.size(), SubchondralPlate::assumed_mm);
  const DensityProbe probe(bone, rays);
  const double step_mm = 0.5 * bone.grid.min_spacing_mm();
  const auto limit = limit_density(probe, subchondral_mm, face, step_mm);
  if (!limit) return plate;
  std::vector<double> ends;
  std::vector<size_t> without;
  size_t count = 0;
  for (size_t ray = 0; ray < rays.size(); ++ray) {
    if (!face[ray]) continue;
    ++count;
    const auto end = end_of_plate(probe, ray, subchondral_mm[ray], *limit, step_mm);
    if (end)
      ends.push_back(plate.thickness_mm[ray] = *end);
    else
      without.push_back(ray);
  }
  if (static_cast<double>(ends.size()) < enough_share * static_cast<double>(count)) {
    plate.thickness_mm.assign(rays.size(), SubchondralPlate::assumed_mm);
    return plate;
  }
  plate.found_by_density = true;
  plate.median_mm = median(std::move(ends));
  for (const size_t ray : without) plate.thickness_mm[ray] = plate.median_mm;
  return plate;
}

}  // namespace ream::score
