#include "score/sphere_fit.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace ream::score {
namespace {

constexpr size_t min_points = 12;
constexpr double max_radius_mm = 500.0, min_radius_mm = 0.1;
constexpr int max_steps = 50;
constexpr double settled_mm = 1e-9;
constexpr double flat = 1e-10;  // of the greatest spread, squared

Vec3 mean_of(std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// Axes of the points' spread about their mean, the shortest first.
Eigen::SelfAdjointEigenSolver<Mat3> spread_of(std::span<const Vec3> points, const Vec3& mean) {
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : points) spread += (p - mean) * (p - mean).transpose();
  return Eigen::SelfAdjointEigenSolver<Mat3>(spread);
}

/// |p|^2 = 2 c p + (r^2 - c^2) by least squares; about the mean for the sake of rounding.
FittedSphere algebraic(std::span<const Vec3> points, const Vec3& mean) {
  Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  for (const Vec3& point : points) {
    const Vec3 p = point - mean;
    const Eigen::Vector4d row(2.0 * p.x(), 2.0 * p.y(), 2.0 * p.z(), 1.0);
    a += row * row.transpose();
    b += p.squaredNorm() * row;
  }
  const Eigen::Vector4d x = a.ldlt().solve(b);
  const Vec3 centre = x.head<3>();
  return {mean + centre, std::sqrt(std::max(0.0, x[3] + centre.squaredNorm())), 0.0};
}

/// Gauss and Newton on distances, from the algebraic sphere on.
void refine(std::span<const Vec3> points, FittedSphere& sphere) {
  for (int step = 0; step < max_steps; ++step) {
    Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
    Eigen::Vector4d b = Eigen::Vector4d::Zero();
    for (const Vec3& point : points) {
      const Vec3 from_centre = point - sphere.centre_mm;
      const double distance = from_centre.norm();
      if (!(distance > 0.0)) continue;
      Eigen::Vector4d row;
      row << from_centre / distance, 1.0;
      a += row * row.transpose();
      b += (distance - sphere.radius_mm) * row;
    }
    const Eigen::Vector4d x = a.ldlt().solve(b);
    if (!x.allFinite()) return;
    sphere.centre_mm += x.head<3>();
    sphere.radius_mm += x[3];
    if (x.norm() < settled_mm) return;
  }
}

}  // namespace

std::optional<FittedSphere> fit_sphere(std::span<const Vec3> points) {
  if (points.size() < min_points) return std::nullopt;
  const auto usable = [](const FittedSphere& s) {
    return s.centre_mm.allFinite() && s.radius_mm > min_radius_mm && s.radius_mm <= max_radius_mm;
  };
  const Vec3 mean = mean_of(points);
  const auto axes = spread_of(points, mean);
  if (!(axes.eigenvalues()[0] > flat * axes.eigenvalues()[2])) return std::nullopt;
  FittedSphere sphere = algebraic(points, mean);
  if (!usable(sphere)) return std::nullopt;
  refine(points, sphere);
  if (!usable(sphere)) return std::nullopt;
  double sum = 0.0;
  for (const Vec3& p : points) sum += std::abs((p - sphere.centre_mm).norm() - sphere.radius_mm);
  sphere.mean_deviation_mm = sum / static_cast<double>(points.size());
  return sphere;
}

std::optional<Vec3> fit_depth_plane(std::span<const Vec3> points, double bound_mm) {
  if (points.size() < 3) return std::nullopt;
  const Vec3 mean = mean_of(points);
  Vec3 plane = Vec3::Zero();  // height at the mean, slopes along x and y
  for (int step = 0; step < max_steps; ++step) {
    Mat3 a = Mat3::Zero();
    Vec3 b = Vec3::Zero();
    for (const Vec3& point : points) {
      const Vec3 p = point - mean, row(1.0, p.x(), p.y());
      const double off = std::abs(p.z() - plane.dot(row));
      const double weight = step == 0 || off <= bound_mm ? 1.0 : bound_mm / off;
      a += weight * row * row.transpose();
      b += weight * p.z() * row;
    }
    const Eigen::SelfAdjointEigenSolver<Mat3> spread(a);
    if (!(spread.eigenvalues()[0] > flat * spread.eigenvalues()[2])) return std::nullopt;
    const Vec3 next = a.ldlt().solve(b);
    const double change = (next - plane).norm();
    plane = next;
    if (change < settled_mm) break;
  }
  return Vec3(-plane.y(), -plane.z(), 1.0).normalized();
}

}  // namespace ream::score
