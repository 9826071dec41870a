#include "shell/mesh_envelope.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace ream::shell {
namespace {

using Corners = std::array<Vec3, 3>;
using Vec2 = Eigen::Vector2d;

Corners corners_of(const TriangleMesh& mesh, const std::array<uint32_t, 3>& t) {
  return {mesh.vertices_mm[t[0]].cast<double>(), mesh.vertices_mm[t[1]].cast<double>(),
          mesh.vertices_mm[t[2]].cast<double>()};
}

/// Seen along the axis: twice the signed area of a, b, p.
double side_of(const Vec3& a, const Vec3& b, const Vec2& p) {
  return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
}

bool covers(const Corners& c, const Vec2& p) {
  const double s0 = side_of(c[0], c[1], p), s1 = side_of(c[1], c[2], p), s2 = side_of(c[2], c[0], p);
  return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

double nearest_radius(const Corners& c) {
  const Vec3 n = (c[1] - c[0]).cross(c[2] - c[0]);
  if (n.z() != 0.0 && covers(c, Vec2::Zero())) return 0.0;
  double nearest = std::numeric_limits<double>::max();
  for (size_t i = 0; i < 3; ++i) {
    const Vec2 a = c[i].head<2>(), ab = c[(i + 1) % 3].head<2>() - a;
    const double length2 = ab.squaredNorm();
    const double along = length2 > 0.0 ? std::clamp(-a.dot(ab) / length2, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, (a + along * ab).norm());
  }
  return nearest;
}

/// Highest z where the edge crosses the cylinder of that radius; -infinity when it does not.
double highest_on_edge(const Vec3& a, const Vec3& b, double radius_mm) {
  const Vec2 from = a.head<2>(), step = b.head<2>() - a.head<2>();
  const double qa = step.squaredNorm(), qb = from.dot(step), qc = from.squaredNorm() - radius_mm * radius_mm;
  const double discriminant = qb * qb - qa * qc;
  double highest = -std::numeric_limits<double>::infinity();
  if (qa <= 0.0 || discriminant < 0.0) return highest;
  const double root = std::sqrt(discriminant);
  for (const double t : {(-qb - root) / qa, (-qb + root) / qa})
    if (t >= 0.0 && t <= 1.0) highest = std::max(highest, a.z() + t * (b.z() - a.z()));
  return highest;
}

/// On the circle a plane is highest where the circle points along the plane's slope.
double highest_inside(const Corners& c, double radius_mm) {
  constexpr double none = -std::numeric_limits<double>::infinity();
  const Vec3 n = (c[1] - c[0]).cross(c[2] - c[0]);
  if (n.z() == 0.0) return none;
  const Vec2 slope(-n.x() / n.z(), -n.y() / n.z());
  const double steepness = slope.norm();
  const Vec2 p = steepness > 0.0 ? Vec2(slope * (radius_mm / steepness)) : Vec2(radius_mm, 0.0);
  return covers(c, p) ? c[0].z() + slope.dot(p - c[0].head<2>()) : none;
}

}  // namespace

MeshEnvelope::MeshEnvelope(TriangleMesh mesh) : mesh_(std::move(mesh)) {
  for (const auto& t : mesh_.triangles) {
    const Corners c = corners_of(mesh_, t);
    nearest_radius_mm_.push_back(nearest_radius(c));
    farthest_radius_mm_.push_back(
        std::max({c[0].head<2>().norm(), c[1].head<2>().norm(), c[2].head<2>().norm()}));
    max_radius_mm_ = std::max(max_radius_mm_, farthest_radius_mm_.back());
  }
}

double MeshEnvelope::min_radius_mm() const {
  return nearest_radius_mm_.empty() ? 0.0
                                    : *std::min_element(nearest_radius_mm_.begin(), nearest_radius_mm_.end());
}

double MeshEnvelope::extreme_z_mm(double radius_mm, double sign) const {
  double highest = -std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < mesh_.triangles.size(); ++i) {
    if (radius_mm < nearest_radius_mm_[i] || radius_mm > farthest_radius_mm_[i]) continue;
    Corners c = corners_of(mesh_, mesh_.triangles[i]);
    for (Vec3& corner : c) corner.z() *= sign;
    for (size_t k = 0; k < 3; ++k)
      highest = std::max(highest, highest_on_edge(c[k], c[(k + 1) % 3], radius_mm));
    highest = std::max(highest, highest_inside(c, radius_mm));
  }
  return highest;
}

}  // namespace ream::shell
