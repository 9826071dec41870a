#include "collide/contact_shell.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace ream::collide {
namespace {

constexpr double unit_code = 127.0;

int16_t coded(double value) { return static_cast<int16_t>(std::lround(value * unit_code)); }

/// One length below the surface; where the surface faces along the axis, also two lengths nearer to it.
Vec3 guiding_probe(const Vec3& surface_mm, const Vec3& normal, double length_mm) {
  const double radius_mm = std::hypot(surface_mm.x(), surface_mm.y());
  const double inwards_mm = std::min(radius_mm, 2.0 * length_mm * std::abs(normal.z()));
  const Vec3 radial = radius_mm > 0.0 ? Vec3(surface_mm.x() / radius_mm, surface_mm.y() / radius_mm, 0.0)
                                      : Vec3(Vec3::Zero());
  return surface_mm - length_mm * normal - inwards_mm * radial;
}

}  // namespace

ContactShell make_contact_shell(const shell::PointShell& shell, double probe_length_mm) {
  ContactShell out;
  const size_t n = shell.points.size();
  out.probe_x_mm.reserve(n), out.probe_y_mm.reserve(n), out.probe_z_mm.reserve(n);
  out.vectors.reserve(n), out.weights.reserve(n), out.guiding.reserve(n);
  out.probe_length_mm = probe_length_mm;
  out.cell_area_mm2 = shell.spacing_mm * shell.spacing_mm;
  double longest = 0.0;
  for (const auto& p : shell.points) longest = std::max(longest, shell.surface_point_mm(p).norm());
  out.moment_length_mm = std::max(longest, 1.0);

  for (const auto& p : shell.points) {
    const Vec3 normal = Vec3(p.normal[0], p.normal[1], p.normal[2]).normalized();
    const Vec3 surface = shell.surface_point_mm(p);
    const bool cuts = p.role == shell::SurfaceRole::cutting;
    const Vec3 probe =
        cuts ? Vec3(surface + probe_length_mm * normal) : guiding_probe(surface, normal, probe_length_mm);
    const Vec3 arm = surface.cross(normal) / out.moment_length_mm;
    out.probe_x_mm.push_back(static_cast<float>(probe.x()));
    out.probe_y_mm.push_back(static_cast<float>(probe.y()));
    out.probe_z_mm.push_back(static_cast<float>(probe.z()));
    out.vectors.push_back({coded(normal.x()), coded(normal.y()), coded(normal.z()), coded(arm.x()),
                           coded(arm.y()), coded(arm.z()), 1, 0});
    out.weights.push_back(p.area_weight);
    out.guiding.push_back(cuts ? 0 : 1);
    out.bounds_mm.include(probe);
  }
  out.blocks = shell.blocks;
  for (auto& block : out.blocks) block.radius_mm += static_cast<float>(probe_length_mm);
  return out;
}

}  // namespace ream::collide
