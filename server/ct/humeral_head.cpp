#include "ct/humeral_head.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "ct/volume_sampling.hpp"

namespace ream::ct {
namespace {

constexpr double coarse_mm = 2.0;
constexpr double least_gradient_hu_mm = 30.0;
constexpr double apart_mm = 20.0;
constexpr size_t most_candidates = 12;
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
        if (steepness < least_gradient_hu_mm) continue;
        const Vec3 step = (gradient.array() / (steepness * coarse.spacing_mm.array())).matrix();
        for (double r = least_head_radius_mm; r <= greatest_head_radius_mm; r += coarse_mm) {
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
  for (size_t k = 0; k < kept && places.size() < most_candidates; ++k) {
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
  constexpr double step_mm = 0.5, reach_mm = 1.0, least_fall_hu = 80.0;
  std::optional<double> best;
  double best_fall = least_fall_hu;
  for (double r = std::max(from_mm, reach_mm); r <= to_mm; r += step_mm) {
    const double within = hu_at_world(volume, centre_mm + (r - reach_mm) * direction);
    if (within < threshold_hu) continue;
    const double fall = within - hu_at_world(volume, centre_mm + (r + reach_mm) * direction);
    if (fall > best_fall) best_fall = fall, best = r;
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
  double low_mm = least_head_radius_mm - 4.0, high_mm = greatest_head_radius_mm + 4.0;
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
  if (head.radius_mm < least_head_radius_mm || head.radius_mm > greatest_head_radius_mm) return std::nullopt;
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
