#include "support/component_truth.hpp"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include "core/units.hpp"

namespace ream::test {
namespace {

/// Of a plan's component: {superior, diameter, length} of pegs, {height, thickness, tip height, tip
/// thickness, length} of a keel.
struct Sizes {
  std::vector<std::array<double, 3>> pegs;
  std::vector<std::array<double, 5>> keels;
};

Sizes sizes_of(std::string_view name) {
  if (name == "pegged small") return {{{0, 6, 13}, {8, 4, 9}, {-8, 4, 9}}, {}};
  if (name == "pegged medium" || name.empty()) return {{{0, 7, 15}, {9, 4.5, 10}, {-9, 4.5, 10}}, {}};
  if (name == "pegged large") return {{{0, 7.5, 17}, {11, 5, 11}, {-11, 5, 11}}, {}};
  if (name == "keeled small") return {{}, {{15, 3.5, 10, 2.2, 11}}};
  if (name == "keeled medium") return {{}, {{18, 4, 12, 2.5, 13}}};
  if (name == "keeled large") return {{}, {{21, 4.5, 14, 2.8, 15}}};
  throw std::invalid_argument("no component " + std::string(name));
}

/// Points of a part as (anterior, superior, into the bone), a third of a millimetre apart or less.
std::vector<Vec3> points_of_peg(const std::array<double, 3>& peg) {
  std::vector<Vec3> points;
  for (double z = 2.0; z < peg[2] + 0.2; z += 0.25)
    for (int i = 0; i < 72; ++i) {
      const double angle = 2.0 * pi * i / 72.0;
      points.emplace_back(0.5 * peg[1] * std::cos(angle), peg[0] + 0.5 * peg[1] * std::sin(angle),
                          std::min(z, peg[2]));
    }
  return points;
}

std::vector<Vec3> points_of_keel(const std::array<double, 5>& keel) {
  std::vector<Vec3> points;
  for (double z = 2.0; z < keel[4] + 0.2; z += 0.25) {
    const double at = std::min(z, keel[4]), t = at / keel[4];
    const double height = keel[0] + t * (keel[2] - keel[0]), thickness = keel[1] + t * (keel[3] - keel[1]);
    for (int i = -30; i <= 30; ++i)
      for (const double side : {-0.5, 0.5}) points.emplace_back(side * thickness, height * i / 60.0, at);
  }
  return points;
}

/// The vault's outside in its own frame: x anterior, y superior, z medial from the centre of the face.
class Vault {
 public:
  explicit Vault(const AnalyticGlenoid& glenoid) : g_(glenoid), f_(glenoid.frame()) {}

  Vec3 inside(const Vec3& world) const {
    const Vec3 p = g_.mirrored(world) - f_.centre;
    return {p.dot(f_.anterior), p.dot(f_.superior), -p.dot(f_.n)};
  }
  bool holds(const Vec3& p) const {
    const double a = half_height(p.z()), b = half_width(p.z());
    return std::hypot(p.y() / a, p.x() / b) < 1.0 && p.z() < g_.vault_mm;
  }
  /// Distance of a place from wall and bottom, by search and ever smaller steps.
  double distance_mm(const Vec3& p, bool finely) const {
    double best = 1e9, angle = 0.0, depth = 0.0;
    const auto look = [&](double phi, double z) {
      if (z > g_.vault_mm || z < lateral_end(phi, z)) return;
      const double away = (wall(phi, z) - p).norm();
      if (away < best) best = away, angle = phi, depth = z;
    };
    const double own = std::atan2(p.y() / half_height(p.z()), p.x() / half_width(p.z()));
    const int turns = finely ? 12 : 4;
    for (int i = -turns; i <= turns; ++i)
      for (double z = -6.0; z <= g_.vault_mm; z += finely ? 0.5 : 2.0) look(own + i * pi / (2.0 * turns), z);
    double step = 1.0;
    for (int halving = 0; finely && halving < 14; ++halving, step *= 0.6) {
      const double phi = angle, z = depth;
      for (int i = -2; i <= 2; ++i)
        for (int k = -2; k <= 2; ++k) look(phi + i * step / 15.0, std::min(g_.vault_mm, z + k * step));
    }
    return std::min(best, to_bottom(p));
  }

 private:
  double narrowing(double z) const { return std::clamp(z / 24.0, -0.3, 1.0); }
  double half_height(double z) const { return 0.5 * g_.shoulder.height_mm * (1.0 - 0.15 * narrowing(z)); }
  double half_width(double z) const { return 0.5 * g_.shoulder.width_mm * (1.0 - 0.45 * narrowing(z)); }
  Vec3 wall(double phi, double z) const {
    return {half_width(z) * std::cos(phi), half_height(z) * std::sin(phi), z};
  }
  /// Where the wall ends at the sphere of the face.
  double lateral_end(double phi, double z) const {
    const Vec3 p = wall(phi, z);
    const double r2 = p.x() * p.x() + p.y() * p.y(), R = g_.radius_mm;
    return r2 < R * R ? std::sqrt(R * R - r2) - R : -1e9;
  }
  /// To the flat end of the vault, within it.
  double to_bottom(const Vec3& p) const {
    const double z = g_.vault_mm, a = half_height(z), b = half_width(z);
    if (std::hypot(p.y() / a, p.x() / b) > 1.0) return 1e9;
    return std::abs(z - p.z());
  }

  AnalyticGlenoid g_;
  AnalyticGlenoid::Frame f_;
};

/// Of the glenoid's superior, what lies across an axis; world.
Vec3 superior_across(const AnalyticGlenoid& glenoid, const Vec3& axis) {
  const Vec3 up = glenoid.mirrored(glenoid.frame().superior);
  return (up - up.dot(axis) * axis).normalized();
}

Vec3 articular_middle(const SeatedTruth& seated) { return seated.apex_mm - 4.0 * seated.axis; }

}  // namespace

double joint_line_truth_mm(const PlannedReaming& planned, const SeatedTruth& seated) {
  return (planned.plan.entry_mm - articular_middle(seated)).dot(planned.plan.axis_direction);
}

double lateralization_truth_mm(const PlannedReaming& planned, const SeatedTruth& seated) {
  const double turn = radians_from_degrees(planned.glenoid.shoulder.plane_deg);
  const Vec3 lateral = planned.glenoid.mirrored(Vec3(-std::cos(turn), -std::sin(turn), 0.0));
  return (articular_middle(seated) - planned.plan.entry_mm).dot(lateral);
}

std::vector<double> vault_truth_mm(const AnalyticGlenoid& glenoid, const SeatedTruth& seated,
                                   std::string_view component) {
  const Vault vault(glenoid);
  const Sizes sizes = sizes_of(component);
  std::vector<std::vector<Vec3>> parts;
  for (const auto& peg : sizes.pegs) parts.push_back(points_of_peg(peg));
  for (const auto& keel : sizes.keels) parts.push_back(points_of_keel(keel));
  // Which way is anterior does not matter, as all are symmetric.
  const Vec3 superior = superior_across(glenoid, seated.axis), anterior = seated.axis.cross(superior);
  const auto signed_mm = [&](const Vec3& place, bool finely) {
    return (vault.holds(place) ? 1.0 : -1.0) * vault.distance_mm(place, finely);
  };
  std::vector<double> least;
  for (const auto& part : parts) {
    std::vector<std::pair<double, Vec3>> roughly;
    for (const Vec3& p : part) {
      const Vec3 place =
          vault.inside(seated.apex_mm + p.x() * anterior + p.y() * superior + p.z() * seated.axis);
      roughly.emplace_back(signed_mm(place, false), place);
    }
    std::sort(roughly.begin(), roughly.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    roughly.resize(std::min<size_t>(roughly.size(), 300));
    least.push_back(1e9);
    for (const auto& each : roughly) least.back() = std::min(least.back(), signed_mm(each.second, true));
  }
  return least;
}

namespace {

/// Unit normal, into the bone, of the plane whose depth along the plan is nearest to that of the points.
Vec3 normal_of(const std::vector<Vec3>& points, const Vec3& along) {
  const Mat3 turn = rotation_with_z_along(along);
  Eigen::MatrixXd over(points.size(), 3);
  Eigen::VectorXd depth(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = turn.transpose() * (points[i] - points.front());
    over.row(static_cast<Eigen::Index>(i)) << p.x(), p.y(), 1.0;
    depth[static_cast<Eigen::Index>(i)] = p.z();
  }
  const Vec3 plane = over.colPivHouseholderQr().solve(depth);
  return turn * Vec3(-plane.x(), -plane.y(), 1.0).normalized();
}

/// Whether bone is left at a place behind the reamed face.
bool is_left(const PlannedReaming& planned, const GlenoidFormulas& formulas, const Vec3& p) {
  const Vec3 offset = p - planned.plan.entry_mm;
  const double deep = offset.dot(planned.plan.axis_direction);
  const bool in_hole =
      planned.plan.pilot_hole && deep < planned.plan.pilot_hole->depth_mm &&
      offset.cross(planned.plan.axis_direction).norm() < 0.5 * planned.plan.pilot_hole->diameter_mm;
  return formulas.solid(p) && !in_hole;
}

}  // namespace

WallTruth wall_truth(const PlannedReaming& planned, const SeatedTruth& seated, double within_mm,
                     double spacing_mm, const std::vector<ReamedPlace>& places) {
  const GlenoidFormulas formulas(planned.glenoid);
  std::map<std::pair<int, int>, Vec3> at;
  for (const ReamedPlace& place : places) at[{place.column, place.row}] = place.world_mm;
  const int reach = static_cast<int>(2.5 / spacing_mm);
  std::vector<double> thickness;
  for (const ReamedPlace& place : places) {
    if ((place.world_mm - seated.apex_mm).cross(seated.axis).norm() > within_mm) continue;
    std::vector<Vec3> around;
    for (int column = -reach; column <= reach; ++column)
      for (int row = -reach; row <= reach; ++row) {
        const auto found = at.find({place.column + column, place.row + row});
        if (found != at.end() && std::hypot(column, row) * spacing_mm <= 2.5) around.push_back(found->second);
      }
    const Vec3 normal = normal_of(around, planned.plan.axis_direction);
    const auto left = [&](double s) { return is_left(planned, formulas, place.world_mm + s * normal); };
    double inside = 0.02;
    while (left(inside + 0.1)) inside += 0.1;
    double outside = inside + 0.1;
    for (int halving = 0; halving < 20; ++halving) {
      const double middle = 0.5 * (inside + outside);
      (left(middle) ? inside : outside) = middle;
    }
    thickness.push_back(inside);
  }
  if (thickness.empty()) return {};
  std::sort(thickness.begin(), thickness.end());
  return {thickness.front(), thickness[thickness.size() / 20]};
}

}  // namespace ream::test
