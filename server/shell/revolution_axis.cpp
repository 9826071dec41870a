#include "shell/revolution_axis.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "shell/mesh_envelope.hpp"

namespace ream::shell {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

constexpr int reweightings = 40;
constexpr double fitting_slope = 0.05;  ///< a triangle fits when its normal leaves the axial plane by less
constexpr double least_fitting_share = 0.5;  ///< of the area
constexpr double least_gap = 1e-3;           ///< next axis' error over the size of the mesh squared
constexpr double least_dome = 0.02;          ///< of the largest radius

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw Error(ErrorKind::invalid_input,
              "mesh " + name + ": " + why + "; give the axis with --tool-axis X,Y,Z,DX,DY,DZ");
}

struct Facet {
  Vec3 centre_mm, normal;
  double area_mm2;
};

std::vector<Facet> facets_about(const TriangleMesh& mesh, const Vec3& origin_mm) {
  std::vector<Facet> facets;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_mm[t[0]].cast<double>(), b = mesh.vertices_mm[t[1]].cast<double>(),
               c = mesh.vertices_mm[t[2]].cast<double>();
    const Vec3 twice_area = (b - a).cross(c - a);
    const double length = twice_area.norm();
    if (length > 0.0) facets.push_back({(a + b + c) / 3.0 - origin_mm, twice_area / length, 0.5 * length});
  }
  return facets;
}

/// The rotation with the velocity field w x p + shift that moves the weighted facets least along their
/// normals.
struct Rotation {
  Vec3 axis = Vec3::UnitZ(), shift = Vec3::Zero();
  double gap_mm2 = 0;  ///< mean squared normal speed of the second best rotation, above the best

  Vec3 point() const { return axis.cross(shift); }
};

Rotation best_rotation(const std::vector<Facet>& facets, const std::vector<double>& weights) {
  Mat6 sums = Mat6::Zero();
  double total = 0.0;
  for (size_t i = 0; i < facets.size(); ++i) {
    Vec6 row;
    row << facets[i].centre_mm.cross(facets[i].normal), facets[i].normal;
    sums += weights[i] * row * row.transpose();
    total += weights[i];
  }
  sums /= total;
  const Mat3 turning = sums.topLeftCorner<3, 3>(), mixed = sums.topRightCorner<3, 3>();
  const Eigen::SelfAdjointEigenSolver<Mat3> shifting(sums.bottomRightCorner<3, 3>());
  Mat3 inverse = Mat3::Zero();  // directions along which the surface may slide leave the point open
  for (int k = 0; k < 3; ++k) {
    const Vec3 v = shifting.eigenvectors().col(k);
    if (shifting.eigenvalues()[k] > 1e-9) inverse += v * v.transpose() / shifting.eigenvalues()[k];
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> left(turning - mixed * inverse * mixed.transpose());
  Rotation best;
  best.axis = left.eigenvectors().col(0);
  best.shift = -(inverse * mixed.transpose() * best.axis);
  best.gap_mm2 = left.eigenvalues()[1] - left.eigenvalues()[0];
  return best;
}

/// How far a facet's normal leaves the plane through the axis: 0 on a surface of revolution, at most 1.
double misfit(const Facet& facet, const Rotation& rotation) {
  const Vec3 velocity = rotation.axis.cross(facet.centre_mm - rotation.point());
  const double speed = velocity.norm();
  return speed > 0.0 ? std::abs(facet.normal.dot(velocity)) / speed : 0.0;
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
  Rotation rotation = best_rotation(facets, weights);
  for (int round = 0; round < reweightings; ++round) {
    const double scale = std::max(0.01, 0.3 * std::pow(0.85, round));
    for (size_t i = 0; i < facets.size(); ++i) {
      const double ratio = misfit(facets[i], rotation) / scale;
      weights[i] = facets[i].area_mm2 / ((1.0 + ratio * ratio) * (1.0 + ratio * ratio));
    }
    rotation = best_rotation(facets, weights);
  }
  double fitting = 0.0, total = 0.0;
  for (const Facet& facet : facets) {
    total += facet.area_mm2;
    if (misfit(facet, rotation) < fitting_slope) fitting += facet.area_mm2;
  }
  if (fitting < least_fitting_share * total) refuse(name, "it is no surface of revolution");
  if (rotation.gap_mm2 < least_gap * size * size) refuse(name, "several axes of revolution are possible");

  const Vec3 point = middle + rotation.point();
  const double ahead = dome_mm(mesh, point, rotation.axis), behind = dome_mm(mesh, point, -rotation.axis);
  if (std::abs(ahead - behind) < least_dome * size) refuse(name, "its cutting side is not clear");
  return {point, ahead > behind ? rotation.axis : Vec3(-rotation.axis)};
}

}  // namespace ream::shell
