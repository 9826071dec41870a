#include "ct/hu_volume.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace ream::ct {
namespace {

constexpr double max_sigma_voxels = 20.0;
constexpr int weight_bits = 16;

/// Half a symmetric kernel in units of 2^-16 whose whole sum is exactly 1, so that constants stay constant.
std::vector<int64_t> gaussian_weights(double sigma_voxels) {
  const int radius = std::max(1, static_cast<int>(std::ceil(3.0 * sigma_voxels)));
  std::vector<double> exact;
  double sum = 0.0;
  for (int i = 0; i <= radius; ++i) {
    exact.push_back(std::exp(-0.5 * i * i / (sigma_voxels * sigma_voxels)));
    sum += (i == 0 ? 1.0 : 2.0) * exact.back();
  }
  std::vector<int64_t> weights;
  int64_t rest = int64_t{1} << weight_bits;
  for (int i = 1; i <= radius; ++i) {
    weights.push_back(std::llround(exact[static_cast<size_t>(i)] / sum * (1 << weight_bits)));
    rest -= 2 * weights.back();
  }
  weights.insert(weights.begin(), rest);
  return weights;
}

void smooth_axis(HuVolume& volume, int axis, double sigma_voxels) {
  const auto weights = gaussian_weights(sigma_voxels);
  const int radius = static_cast<int>(weights.size()) - 1, n = volume.dims[axis];
  const size_t stride = axis == 0 ? 1
                        : axis == 1
                            ? static_cast<size_t>(volume.dims.x())
                            : static_cast<size_t>(volume.dims.x()) * static_cast<size_t>(volume.dims.y());
  std::vector<int64_t> line(static_cast<size_t>(n + 2 * radius));
  Vec3i end = volume.dims;
  end[axis] = 1;
  for (int w = 0; w < end.z(); ++w)
    for (int v = 0; v < end.y(); ++v)
      for (int u = 0; u < end.x(); ++u) {
        int16_t* first = volume.hu.data() + volume.index(u, v, w);
        for (int i = -radius; i < n + radius; ++i)
          line[static_cast<size_t>(i + radius)] =
              first[static_cast<size_t>(std::clamp(i, 0, n - 1)) * stride];
        for (int i = 0; i < n; ++i) {
          const int64_t* centre = line.data() + i + radius;
          int64_t sum = weights[0] * centre[0];
          for (int k = 1; k <= radius; ++k) sum += weights[static_cast<size_t>(k)] * (centre[k] + centre[-k]);
          sum += int64_t{1} << (weight_bits - 1);
          first[static_cast<size_t>(i) * stride] = static_cast<int16_t>(sum >> weight_bits);
        }
      }
}

}  // namespace

HuVolume cropped(const HuVolume& volume, const Aabb& roi_mm) {
  if (!((roi_mm.max - roi_mm.min).minCoeff() > 0.0))
    throw Error(ErrorKind::invalid_input,
                "the region of interest has no volume; give X0,Y0,Z0,X1,Y1,Z1 with both corners different");
  const Aabb box = roi_mm.transformed(volume.world_from_volume.inverse());
  constexpr double slack = 1e-6;  // a border that lies on a voxel border takes no further voxel
  const Vec3i low = (box.min.array() / volume.spacing_mm.array() + slack)
                        .floor()
                        .max(-1e6)
                        .cast<int>()
                        .matrix()
                        .cwiseMax(0);
  const Vec3i high = (box.max.array() / volume.spacing_mm.array() - slack)
                         .ceil()
                         .min(1e6)
                         .cast<int>()
                         .matrix()
                         .cwiseMin(volume.dims);
  if ((high.array() <= low.array()).any()) {
    const Aabb world =
        Aabb{Vec3::Zero(), (volume.dims.cast<double>().array() * volume.spacing_mm.array()).matrix()}
            .transformed(volume.world_from_volume);
    const auto text = [](const Vec3& p) {
      return std::to_string(std::lround(p.x())) + "," + std::to_string(std::lround(p.y())) + "," +
             std::to_string(std::lround(p.z()));
    };
    throw Error(ErrorKind::invalid_input, "the region of interest lies outside the CT, which spans " +
                                              text(world.min) + " to " + text(world.max) + " mm (LPS)");
  }
  HuVolume result;
  result.dims = high - low;
  result.spacing_mm = volume.spacing_mm;
  result.world_from_volume = volume.world_from_volume;
  result.world_from_volume.translation_mm =
      volume.world_from_volume.point((low.cast<double>().array() * volume.spacing_mm.array()).matrix());
  result.source = volume.source;
  result.warnings = volume.warnings;
  result.patient = volume.patient;
  result.hu.reserve(result.voxel_count());
  for (int w = low.z(); w < high.z(); ++w)
    for (int v = low.y(); v < high.y(); ++v) {
      const auto row = volume.hu.begin() + static_cast<std::ptrdiff_t>(volume.index(low.x(), v, w));
      result.hu.insert(result.hu.end(), row, row + result.dims.x());
    }
  return result;
}

void smooth(HuVolume& volume, double sigma_mm) {
  if (!(sigma_mm >= 0.0) || sigma_mm > max_sigma_voxels * volume.spacing_mm.minCoeff())
    throw Error(ErrorKind::invalid_input, "smoothing sigma " + std::to_string(sigma_mm) +
                                              " mm must be from 0 to 20 voxels; check --sigma-mm");
  if (sigma_mm == 0.0) return;
  for (int axis = 0; axis < 3; ++axis) {
    const double sigma_voxels = sigma_mm / volume.spacing_mm[axis];
    // Below a tenth of a voxel the kernel is a single one.
    if (sigma_voxels > 0.1) smooth_axis(volume, axis, sigma_voxels);
  }
}

}  // namespace ream::ct
