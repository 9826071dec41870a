#include "ct/segment/humeral_head.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace ream::ct {
namespace {

/// Mean of every three along one axis: `count` values, `stride` apart, `lines` times from each start.
void blur_line(float* first, size_t count, size_t stride) {
  float before = 0.0F, here = first[0];
  for (size_t i = 0; i < count; ++i) {
    const float after = i + 1 < count ? first[(i + 1) * stride] : 0.0F;
    first[i * stride] = (before + here + after) / 3.0F;
    before = here;
    here = after;
  }
}

/// HU at a world point (LPS mm), trilinear between voxel centres; the edge's value beyond it.
double hu_at_world(const HuVolume& volume, const Vec3& world_mm) {
  const Pose& pose = volume.world_from_volume;
  const Vec3 p = pose.rotation.transpose() * (world_mm - pose.translation_mm);
  const Vec3 at = (p.array() / volume.spacing_mm.array() - 0.5).matrix();
  size_t low[3], high[3];
  double part[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double last = volume.dims[axis] - 1, clamped = std::clamp(at[axis], 0.0, last);
    const double base = std::floor(clamped);
    low[axis] = static_cast<size_t>(base);
    high[axis] = static_cast<size_t>(std::min(base + 1.0, last));
    part[axis] = clamped - base;
  }
  const auto nx = static_cast<size_t>(volume.dims.x()), ny = static_cast<size_t>(volume.dims.y());
  const auto hu = [&](size_t u, size_t v, size_t w) {
    return static_cast<double>(volume.hu[u + nx * (v + ny * w)]);
  };
  const auto row = [&](size_t v, size_t w) {
    return hu(low[0], v, w) * (1.0 - part[0]) + hu(high[0], v, w) * part[0];
  };
  const auto slice = [&](size_t w) { return row(low[1], w) * (1.0 - part[1]) + row(high[1], w) * part[1]; };
  return slice(low[2]) * (1.0 - part[2]) + slice(high[2]) * part[2];
}

/// Means over blocks of whole voxels, as many along each axis as come nearest to `size_mm`. Rows that fill no
/// block are left out. The same place in the world.
HuVolume coarsened(const HuVolume& volume, double size_mm) {
  Vec3i block;
  HuVolume coarse;
  coarse.world_from_volume = volume.world_from_volume;
  for (int axis = 0; axis < 3; ++axis) {
    const double fitting = std::floor(size_mm / volume.spacing_mm[axis] + 0.5);
    block[axis] = static_cast<int>(std::clamp(fitting, 1.0, static_cast<double>(volume.dims[axis])));
    coarse.dims[axis] = volume.dims[axis] / block[axis];
    coarse.spacing_mm[axis] = volume.spacing_mm[axis] * block[axis];
  }
  std::vector<int64_t> sums(coarse.voxel_count());
  const Vec3i used = coarse.dims.cwiseProduct(block);
  for (int w = 0; w < used.z(); ++w)
    for (int v = 0; v < used.y(); ++v) {
      const int16_t* row = volume.hu.data() + volume.index(0, v, w);
      int64_t* sum = sums.data() + coarse.index(0, v / block.y(), w / block.z());
      for (int u = 0; u < coarse.dims.x(); ++u, ++sum)
        for (int i = 0; i < block.x(); ++i) *sum += *row++;
    }
  const int64_t count = int64_t{block.x()} * block.y() * block.z();
  coarse.hu.resize(sums.size());
  std::transform(sums.begin(), sums.end(), coarse.hu.begin(),
                 [&](int64_t sum) { return static_cast<int16_t>(sum / count); });
  return coarse;
}

/// Central differences in the volume's axes, HU per mm; 0 across the volume's border.
Vec3 gradient_hu_mm(const HuVolume& volume, const Vec3i& o) {
  Vec3 gradient = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    Vec3i before = o, after = o;
    --before[axis], ++after[axis];
    if (!volume.contains(before) || !volume.contains(after)) continue;
    const int difference = volume.hu[volume.index(after.x(), after.y(), after.z())] -
                           volume.hu[volume.index(before.x(), before.y(), before.z())];
    gradient[axis] = difference / (2.0 * volume.spacing_mm[axis]);
  }
  return gradient;
}

/// Mean over 3 x 3 x 3 neighbours, beyond the border 0.
void blur(std::vector<float>& values, const Vec3i& dims) {
  const auto nx = static_cast<size_t>(dims.x()), ny = static_cast<size_t>(dims.y()),
             nz = static_cast<size_t>(dims.z());
  for (size_t i = 0; i < ny * nz; ++i) blur_line(values.data() + i * nx, nx, 1);
  for (size_t w = 0; w < nz; ++w)
    for (size_t u = 0; u < nx; ++u) blur_line(values.data() + w * nx * ny + u, ny, nx);
  for (size_t i = 0; i < nx * ny; ++i) blur_line(values.data() + i, nz, nx * ny);
}

constexpr double coarse_mm = 2.0;
constexpr double min_gradient_hu_mm = 30.0;
constexpr double apart_mm = 20.0;
constexpr size_t max_candidates = 12;
constexpr int rays = 600;

/// How well each coarse voxel would do as the centre of a head.
std::vector<float> votes_in(const HuVolume& coarse, double bone_hu) {
  std::vector<float> votes(coarse.voxel_count());
  for (int w = 0; w < coarse.dims.z(); ++w)
    for (int v = 0; v < coarse.dims.y(); ++v)
      for (int u = 0; u < coarse.dims.x(); ++u) {
        if (coarse.hu[coarse.index(u, v, w)] < bone_hu) continue;
        const Vec3 gradient = gradient_hu_mm(coarse, {u, v, w});
        const double steepness = gradient.norm();
        if (steepness < min_gradient_hu_mm) continue;
        const Vec3 step = (gradient.array() / (steepness * coarse.spacing_mm.array())).matrix();
        for (double r = min_head_radius_mm; r <= max_head_radius_mm; r += coarse_mm) {
          const Vec3i o = (Vec3(u + 0.5, v + 0.5, w + 0.5) + r * step).array().floor().cast<int>().matrix();
          if (coarse.contains(o)) votes[coarse.index(o.x(), o.y(), o.z())] += 1.0F;
        }
      }
  blur(votes, coarse.dims);
  blur(votes, coarse.dims);
  return votes;
}

std::vector<Vec3> best_places(const HuVolume& coarse, const std::vector<float>& votes) {
  std::vector<size_t> order;
  for (size_t i = 0; i < votes.size(); ++i)
    if (votes[i] > 0.0F) order.push_back(i);
  const size_t kept = std::min<size_t>(order.size(), 4000);
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept), order.end(),
                    [&](size_t a, size_t b) { return votes[a] != votes[b] ? votes[a] > votes[b] : a < b; });
  std::vector<Vec3> places;
  const auto nx = static_cast<size_t>(coarse.dims.x()), ny = static_cast<size_t>(coarse.dims.y());
  for (size_t k = 0; k < kept && places.size() < max_candidates; ++k) {
    const size_t i = order[k];
    const Vec3 place = coarse.world_of_centre(
        {static_cast<int>(i % nx), static_cast<int>((i / nx) % ny), static_cast<int>(i / (nx * ny))});
    const bool fresh = std::all_of(places.begin(), places.end(),
                                   [&](const Vec3& other) { return (other - place).norm() >= apart_mm; });
    if (fresh) places.push_back(place);
  }
  return places;
}

/// Evenly spread over the sphere (Fibonacci's spiral).
Vec3 ray_direction(int number) {
  const double z = 1.0 - (2.0 * number + 1.0) / rays, ring = std::sqrt(1.0 - z * z);
  const double turn = pi * (3.0 - std::sqrt(5.0)) * number;
  return {ring * std::cos(turn), ring * std::sin(turn), z};
}

/// Where, along a ray, HU falls most steeply from bone to less, between two radii; empty without such a fall.
std::optional<double> outer_surface_mm(const HuVolume& volume, const Vec3& centre_mm, const Vec3& direction,
                                       double from_mm, double to_mm, double threshold_hu) {
  constexpr double step_mm = 0.5, reach_mm = 1.0, min_fall_hu = 80.0;
  std::optional<double> best;
  double best_fall = min_fall_hu;
  for (double r = std::max(from_mm, reach_mm); r <= to_mm; r += step_mm) {
    const double within = hu_at_world(volume, centre_mm + (r - reach_mm) * direction);
    if (within < threshold_hu) continue;
    const double fall = within - hu_at_world(volume, centre_mm + (r + reach_mm) * direction);
    // Beyond the CT the edge's values go on, which is no surface.
    if (fall > best_fall && volume.contains(volume.voxel_at_world(centre_mm + r * direction)))
      best_fall = fall, best = r;
  }
  return best;
}

/// Least squares of |p|^2 = 2 c p + (r^2 - |c|^2) about `origin`.
HumeralHead sphere_through(const std::vector<Vec3>& points, const Vec3& origin) {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (const Vec3& p : points) {
    const Vec3 q = p - origin;
    const Eigen::Vector4d row(2.0 * q.x(), 2.0 * q.y(), 2.0 * q.z(), 1.0);
    normal += row * row.transpose();
    right += row * q.squaredNorm();
  }
  const Eigen::Vector4d x = normal.ldlt().solve(right);
  HumeralHead head;
  head.centre_mm = origin + x.head<3>();
  head.radius_mm = std::sqrt(std::max(0.0, x[3] + x.head<3>().squaredNorm()));
  return head;
}

}  // namespace

std::optional<HumeralHead> fitted_head(const HuVolume& volume, double threshold_hu, const Vec3& near_mm) {
  constexpr double on_sphere_mm = 1.25;
  HumeralHead head;
  head.centre_mm = near_mm;
  double low_mm = min_head_radius_mm - 4.0, high_mm = max_head_radius_mm + 4.0;
  for (const double tolerance_mm : {8.0, 6.0, 4.0, 3.0, 2.0, 1.5, 1.5, 1.5}) {
    std::vector<Vec3> points;
    for (int number = 0; number < rays; ++number) {
      const Vec3 d = ray_direction(number);
      if (const auto r = outer_surface_mm(volume, head.centre_mm, d, low_mm, high_mm, threshold_hu))
        points.push_back(head.centre_mm + *r * d);
    }
    if (points.size() < rays / 10) return std::nullopt;
    const HumeralHead fit = sphere_through(points, head.centre_mm);
    if (!fit.centre_mm.allFinite() || (fit.centre_mm - near_mm).norm() > apart_mm) return std::nullopt;
    const auto on_it = std::count_if(points.begin(), points.end(), [&](const Vec3& p) {
      return std::abs((p - fit.centre_mm).norm() - fit.radius_mm) <= on_sphere_mm;
    });
    head = fit;
    head.share = static_cast<double>(on_it) / rays;
    low_mm = head.radius_mm - tolerance_mm;
    high_mm = head.radius_mm + tolerance_mm;
  }
  if (head.radius_mm < min_head_radius_mm || head.radius_mm > max_head_radius_mm) return std::nullopt;
  return head;
}

std::vector<HumeralHead> head_candidates(const HuVolume& volume, double threshold_hu) {
  const HuVolume coarse = coarsened(volume, coarse_mm);
  // A block at the surface is half bone; half the threshold over water still tells it from soft tissue.
  const std::vector<float> votes = votes_in(coarse, 0.6 * threshold_hu);
  std::vector<HumeralHead> heads;
  for (const Vec3& place : best_places(coarse, votes)) {
    const auto head = fitted_head(volume, threshold_hu, place);
    const auto same = [&](const HumeralHead& other) {
      return (other.centre_mm - head->centre_mm).norm() < apart_mm;
    };
    if (head && std::none_of(heads.begin(), heads.end(), same)) heads.push_back(*head);
  }
  std::stable_sort(heads.begin(), heads.end(),
                   [](const HumeralHead& a, const HumeralHead& b) { return a.share > b.share; });
  return heads;
}

}  // namespace ream::ct
