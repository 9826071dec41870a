#include "shell/mesh_tool.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "shell/meridian.hpp"

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
double max_on_edge(const Vec3& a, const Vec3& b, double radius_mm) {
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
double max_inside(const Corners& c, double radius_mm) {
  constexpr double none = -std::numeric_limits<double>::infinity();
  const Vec3 n = (c[1] - c[0]).cross(c[2] - c[0]);
  if (n.z() == 0.0) return none;
  const Vec2 slope(-n.x() / n.z(), -n.y() / n.z());
  const double steepness = slope.norm();
  const Vec2 p = steepness > 0.0 ? Vec2(slope * (radius_mm / steepness)) : Vec2(radius_mm, 0.0);
  return covers(c, p) ? c[0].z() + slope.dot(p - c[0].head<2>()) : none;
}

constexpr int radius_samples = 1000;
constexpr double step_height_mm = 0.2;  ///< between neighbouring samples: the edge is then found exactly
constexpr double edge_accuracy_mm = 5e-4;
constexpr double nipple_slope = 3.0;  ///< z over radius; an ellipse a, b near its apex stays far below
constexpr double nipple_reach = 0.4;  ///< of the largest radius
constexpr double min_nipple_mm = 1.0;
constexpr double wall_slope = 5.7;      ///< 80 degrees
constexpr double wall_width_mm = 0.01;  ///< scatter of a faceted side wall
constexpr double sheet_mm = 0.05, sheet_back_mm = 1.0;
constexpr double simplification_mm = 0.005;

using Heights = std::vector<ProfilePoint>;

/// Adds the two sides of a step between the last point and (radius, z).
template <typename HeightAt>
void add_edge(Heights& heights, const ProfilePoint& next, const HeightAt& height_at) {
  ProfilePoint low = heights.back(), high = next;
  while (high.radius_mm - low.radius_mm > edge_accuracy_mm) {
    const double radius = 0.5 * (low.radius_mm + high.radius_mm), z = height_at(radius);
    if (!std::isfinite(z)) break;
    (std::abs(z - low.z_mm) < std::abs(z - high.z_mm) ? low : high) = {radius, z};
  }
  if (low.radius_mm > heights.back().radius_mm) heights.push_back(low);
  if (high.radius_mm < next.radius_mm) heights.push_back(high);
}

/// The envelope from the axis to the rim; gaps (a hole along the axis) are bridged at the height of their
/// outer border.
template <typename HeightAt>
Heights sample(double max_radius_mm, const HeightAt& height_at) {
  Heights heights;
  const double last_radius = max_radius_mm * (1.0 - 1e-7);
  for (int i = 0; i <= radius_samples; ++i) {
    const ProfilePoint p{last_radius * i / radius_samples, height_at(last_radius * i / radius_samples)};
    if (!std::isfinite(p.z_mm)) continue;
    if (heights.empty() && p.radius_mm > 0.0) heights.push_back({0.0, p.z_mm});
    if (!heights.empty() && std::abs(p.z_mm - heights.back().z_mm) > step_height_mm)
      add_edge(heights, p, height_at);
    heights.push_back(p);
  }
  return heights;
}

double slope_after(const Heights& heights, size_t i) {
  return (heights[i].z_mm - heights[i + 1].z_mm) / (heights[i + 1].radius_mm - heights[i].radius_mm);
}

/// Index of the first point of the cutting surface: 0 without a nipple.
size_t nipple_end(const Heights& front, double max_radius_mm) {
  double fall = 0.0;
  size_t end = 0;
  for (size_t i = 0; i + 1 < front.size() && front[i].radius_mm < nipple_reach * max_radius_mm; ++i)
    if (slope_after(front, i) > nipple_slope) {
      fall += front[i].z_mm - front[i + 1].z_mm;
      end = i + 1;
    }
  return fall > min_nipple_mm ? end : 0;
}

/// Index of the last point of the cutting surface; behind it the front falls as a side wall.
size_t cutting_end(const Heights& front, double max_radius_mm) {
  size_t end = front.size() - 1;
  while (end > 0 && front[end - 1].radius_mm > max_radius_mm - wall_width_mm &&
         slope_after(front, end - 1) > wall_slope)
    --end;
  return end;
}

/// Height at the axis of z = apex + k r^2 fitted to the innermost part of the cutting surface.
double apex_of(const Heights& front, size_t begin, size_t end) {
  if (begin == 0) return front[0].z_mm;
  const double reach =
      front[begin].radius_mm + std::max(1.0, 0.15 * (front[end].radius_mm - front[begin].radius_mm));
  double n = 0, sx = 0, sz = 0, sxx = 0, sxz = 0;
  for (size_t i = begin; i <= end && front[i].radius_mm <= reach; ++i) {
    const double x = front[i].radius_mm * front[i].radius_mm, z = front[i].z_mm;
    n += 1;
    sx += x;
    sz += z;
    sxx += x * x;
    sxz += x * z;
  }
  const double spread = n * sxx - sx * sx;
  return spread > 0.0 ? (sz * sxx - sx * sxz) / spread : front[begin].z_mm;
}

void give_a_sheet_its_back(const Heights& front, Heights& back) {
  double thickest = 0.0, lowest = front[0].z_mm;
  for (const ProfilePoint& p : front) lowest = std::min(lowest, p.z_mm);
  if (front.size() != back.size()) return;
  for (size_t i = 0; i < front.size(); ++i) thickest = std::max(thickest, front[i].z_mm - back[i].z_mm);
  if (thickest < sheet_mm)
    for (ProfilePoint& p : back) p.z_mm = lowest - sheet_back_mm;
}

void add_point(ToolProfile& profile, const ProfilePoint& p, double apex_z_mm, SurfaceRole role) {
  const ProfilePoint moved{p.radius_mm, p.z_mm - apex_z_mm};
  if (!profile.points.empty()) {
    const ProfilePoint& last = profile.points.back();
    if (std::hypot(moved.radius_mm - last.radius_mm, moved.z_mm - last.z_mm) < 1e-6) return;
    profile.roles.push_back(role);
  }
  profile.points.push_back(moved);
}

constexpr int reweightings = 40;
constexpr double fitting_slope = 0.05;     ///< a triangle fits when its normal leaves the axial plane by less
constexpr double min_fitting_share = 0.3;  ///< of the area
constexpr double min_gap = 1e-3;           ///< next axis' error over the size of the mesh squared
constexpr double min_dome = 0.02;          ///< of the largest radius

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
    for (size_t k = 0; k < 3; ++k) highest = std::max(highest, max_on_edge(c[k], c[(k + 1) % 3], radius_mm));
    highest = std::max(highest, max_inside(c, radius_mm));
  }
  return highest;
}

MeasuredProfile tool_profile_from_mesh(const TriangleMesh& mesh, const std::string& name) {
  const MeshEnvelope envelope(mesh);
  const double max_radius = envelope.max_radius_mm();
  if (!(max_radius > 0.0) || envelope.min_radius_mm() > 0.5 * max_radius)
    throw Error(
        ErrorKind::invalid_input,
        "mesh " + name + ": its surface does not reach the tool axis; check --tool-axis X,Y,Z,DX,DY,DZ");
  const Heights front = sample(max_radius, [&](double r) { return envelope.top_mm(r); });
  Heights back = sample(max_radius, [&](double r) { return envelope.bottom_mm(r); });
  give_a_sheet_its_back(front, back);

  const size_t begin = nipple_end(front, max_radius), end = cutting_end(front, max_radius);
  MeasuredProfile measured;
  measured.apex_z_mm = apex_of(front, begin, end);
  ToolProfile& profile = measured.profile;
  for (size_t i = 0; i < front.size(); ++i)
    add_point(profile, front[i], measured.apex_z_mm,
              i <= begin ? SurfaceRole::guiding
              : i <= end ? SurfaceRole::cutting
                         : SurfaceRole::smooth);
  for (size_t i = back.size(); i-- > 0;) add_point(profile, back[i], measured.apex_z_mm, SurfaceRole::smooth);
  profile = simplified(profile, simplification_mm);
  return measured;
}

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
  if (fitting < min_fitting_share * total) refuse(name, "it is no surface of revolution");
  if (rotation.gap_mm2 < min_gap * size * size) refuse(name, "several axes of revolution are possible");

  const Vec3 point = middle + rotation.point_mm;
  const double ahead = dome_mm(mesh, point, rotation.axis), behind = dome_mm(mesh, point, -rotation.axis);
  if (std::abs(ahead - behind) < min_dome * size) refuse(name, "its cutting side is not clear");
  return {point, ahead > behind ? rotation.axis : Vec3(-rotation.axis)};
}

}  // namespace ream::shell
