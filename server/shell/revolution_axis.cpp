#include "shell/revolution_axis.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "shell/mesh_envelope.hpp"

namespace ream::shell {
namespace {

constexpr int reweightings = 40;
constexpr double fitting_slope = 0.05;  ///< a triangle fits when its normal leaves the axial plane by less
constexpr double least_fitting_share = 0.3;  ///< of the area
constexpr double least_gap = 1e-3;           ///< next axis' error over the size of the mesh squared
constexpr double least_dome = 0.02;          ///< of the largest radius

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw Error(ErrorKind::invalid_input,
              "mesh " + name + ": " + why + "; give the axis with --tool-axis X,Y,Z,DX,DY,DZ");
}

/// Middles of the edges stand for the triangle: sums of squares over them are exact integrals over its area.
/// Its centre alone would not do, as it lies off the middle of the strip that approximates a cylinder.
struct Facet {
  std::array<Vec3, 3> middles_mm;
  Vec3 normal;
  double area_mm2;
};

std::vector<Facet> facets_about(const TriangleMesh& mesh, const Vec3& origin_mm) {
  std::vector<Facet> facets;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_mm[t[0]].cast<double>(), b = mesh.vertices_mm[t[1]].cast<double>(),
               c = mesh.vertices_mm[t[2]].cast<double>();
    const Vec3 twice_area = (b - a).cross(c - a);
    const double length = twice_area.norm();
    if (length > 0.0)
      facets.push_back({{0.5 * (a + b) - origin_mm, 0.5 * (b + c) - origin_mm, 0.5 * (c + a) - origin_mm},
                        twice_area / length,
                        0.5 * length});
  }
  return facets;
}

struct Rotation {
  Vec3 axis = Vec3::UnitZ(), point_mm = Vec3::Zero();
  double gap_mm2 = 0;  ///< mean squared normal speed of the next best axis, above the best
};

/// The axis through `point_mm` whose rotation moves the weighted facets least along their normals.
Rotation best_axis(const std::vector<Facet>& facets, const std::vector<double>& weights,
                   const Vec3& point_mm) {
  Mat3 sums = Mat3::Zero();
  double total = 0.0;
  for (size_t i = 0; i < facets.size(); ++i) {
    for (const Vec3& p : facets[i].middles_mm) {
      const Vec3 moment = (p - point_mm).cross(facets[i].normal);
      sums += weights[i] * moment * moment.transpose();
    }
    total += 3.0 * weights[i];
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> best(sums / total);
  return {best.eigenvectors().col(0), point_mm, best.eigenvalues()[1] - best.eigenvalues()[0]};
}

/// The point near the middle through which an axis of that direction does the same.
Vec3 best_point(const std::vector<Facet>& facets, const std::vector<double>& weights, const Vec3& axis) {
  const Mat3 across = rotation_with_z_along(axis);
  Eigen::Matrix2d sums =
      Eigen::Matrix2d::Identity() * 1e-9;  // keeps the point where the surface leaves it open
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (size_t i = 0; i < facets.size(); ++i) {
    const Vec3 lever = facets[i].normal.cross(axis);
    const Eigen::Vector2d row(lever.dot(across.col(0)), lever.dot(across.col(1)));
    sums += 3.0 * weights[i] * row * row.transpose();
    for (const Vec3& p : facets[i].middles_mm) right += weights[i] * row * lever.dot(p);
  }
  const Eigen::Vector2d at = sums.ldlt().solve(right);
  return across.col(0) * at.x() + across.col(1) * at.y();
}

/// How far a facet's normal leaves the planes through the axis: 0 on a surface of revolution, at most 1.
double misfit(const Facet& facet, const Rotation& rotation) {
  double squares = 0.0;
  for (const Vec3& p : facet.middles_mm) {
    const Vec3 velocity = rotation.axis.cross(p - rotation.point_mm);
    const double along_normal = facet.normal.dot(velocity), speed2 = velocity.squaredNorm();
    if (speed2 > 0.0) squares += along_normal * along_normal / speed2;
  }
  return std::sqrt(squares / 3.0);
}

/// How far the envelope falls from the middle radii to the rim, seen against `direction`.
double dome_mm(const TriangleMesh& mesh, const Vec3& point_mm, const Vec3& direction) {
  const Pose tool_from_mesh = Pose{rotation_with_z_along(direction), point_mm}.inverse();
  const MeshEnvelope envelope(mesh.transformed(tool_from_mesh));
  const double r = envelope.max_radius_mm();
  double inner = envelope.top_mm(0.4 * r), outer = envelope.top_mm(0.95 * r);
  if (!std::isfinite(inner) || !std::isfinite(outer)) return 0.0;
  return inner - outer;
}

}  // namespace

ToolAxis estimate_axis(const TriangleMesh& mesh, const std::string& name) {
  const Vec3 middle = mesh.bounds().centre();
  const double size = mesh.bounds().half_size().norm();
  const std::vector<Facet> facets = facets_about(mesh, middle);
  if (facets.empty()) refuse(name, "it has no area");
  std::vector<double> weights(facets.size());
  for (size_t i = 0; i < facets.size(); ++i) weights[i] = facets[i].area_mm2;
  Rotation rotation = best_axis(facets, weights, Vec3::Zero());
  for (int round = 0; round < reweightings; ++round) {
    rotation = best_axis(facets, weights, best_point(facets, weights, rotation.axis));
    const double scale = std::max(fitting_slope, 0.5 * std::pow(0.85, round));
    for (size_t i = 0; i < facets.size(); ++i) {
      const double ratio = misfit(facets[i], rotation) / scale;
      weights[i] = facets[i].area_mm2 / ((1.0 + ratio * ratio) * (1.0 + ratio * ratio));
    }
  }
  double fitting = 0.0, total = 0.0;
  for (const Facet& facet : facets) {
    total += facet.area_mm2;
    if (misfit(facet, rotation) < fitting_slope) fitting += facet.area_mm2;
  }
  if (fitting < least_fitting_share * total) refuse(name, "it is no surface of revolution");
  if (rotation.gap_mm2 < least_gap * size * size) refuse(name, "several axes of revolution are possible");

  const Vec3 point = middle + rotation.point_mm;
  const double ahead = dome_mm(mesh, point, rotation.axis), behind = dome_mm(mesh, point, -rotation.axis);
  if (std::abs(ahead - behind) < least_dome * size) refuse(name, "its cutting side is not clear");
  return {point, ahead > behind ? rotation.axis : Vec3(-rotation.axis)};
}

}  // namespace ream::shell
