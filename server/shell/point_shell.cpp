#include "shell/point_shell.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "geometry/morton.hpp"
#include "shell/meridian.hpp"

namespace ream::shell {
namespace {

constexpr int max_cells_per_side = 2048;
constexpr uint32_t block_bits = 9;             // 8^3 cells
constexpr double facet_error_in_cells = 0.01;  // of the revolved surface that is voxelized
constexpr double tie_in_cells = 1e-4;

/// The profile as a mesh close enough to it that the voxelization is that of the smooth surface.
TriangleMesh fine_mesh(const ToolProfile& profile, double spacing_mm) {
  const double error = std::min(facet_error_in_cells * spacing_mm, 0.1 * profile.max_radius_mm());
  const double sides = pi / std::sqrt(2.0 * error / profile.max_radius_mm());
  return revolve(simplified(profile, error), std::max(12, static_cast<int>(std::ceil(sides))));
}

void check_size(const ToolProfile& profile, double spacing_mm) {
  if (!std::isfinite(spacing_mm) || spacing_mm <= 0.0)
    throw Error(ErrorKind::invalid_input, "tool spacing must be a positive number of mm");
  const double longest_mm = std::max(2.0 * profile.max_radius_mm(), profile.max_z_mm() - profile.min_z_mm());
  if (longest_mm / spacing_mm > max_cells_per_side - 2)
    throw Error(ErrorKind::invalid_input, "tool spacing " + std::to_string(spacing_mm) +
                                              " mm makes more than " + std::to_string(max_cells_per_side) +
                                              " cells along the tool's " + std::to_string(longest_mm) +
                                              " mm; use at least " +
                                              std::to_string(longest_mm / (max_cells_per_side - 2)) + " mm");
}

ShellPoint point_of(const MeridianHit& hit, const Vec3& normal, SurfaceRole role, uint64_t morton) {
  ShellPoint p;
  p.morton = morton;
  p.normal = normal.cast<float>();
  p.area_weight = static_cast<uint8_t>(std::lround(area_weights_a_face / normal.cwiseAbs().maxCoeff()));
  p.surface_offset_mm = static_cast<float>(-hit.signed_distance_mm);
  p.role = role;
  return p;
}

/// A flat face midway between two layers of cells marks both; the outer one is left out where the inner one
/// is there.
bool is_second_layer(const SurfaceVoxels& voxels, const Vec3i& cell, const Vec3& normal, double distance_mm) {
  int axis = 0;
  const double across = normal.cwiseAbs().maxCoeff(&axis);
  if (distance_mm < (0.5 - tie_in_cells) * across * voxels.size_mm) return false;
  Vec3i inner = cell;
  inner[axis] += normal[axis] > 0.0 ? -1 : 1;
  return inner[axis] >= 0 && inner[axis] < voxels.dims[axis] &&
         voxels.filled(inner.x(), inner.y(), inner.z());
}

void add_point(const SurfaceVoxels& voxels, const Meridian& meridian, const Vec3i& cell, bool with_smooth,
               PointShell& shell) {
  const uint64_t code = morton_code(static_cast<uint32_t>(cell.x()), static_cast<uint32_t>(cell.y()),
                                    static_cast<uint32_t>(cell.z()));
  const Vec3 centre = shell.cell_centre_mm(code);
  const double radius = std::hypot(centre.x(), centre.y());
  const MeridianHit hit = meridian.nearest(radius, centre.z());
  const SurfaceRole role = meridian.profile().roles[hit.segment];
  if (!with_smooth && role == SurfaceRole::smooth) return;
  const double cos_angle = radius > 0.0 ? centre.x() / radius : 1.0;
  const double sin_angle = radius > 0.0 ? centre.y() / radius : 0.0;
  const Vec3 normal(hit.normal_radial * cos_angle, hit.normal_radial * sin_angle, hit.normal_z);
  if (!is_second_layer(voxels, cell, normal, hit.signed_distance_mm))
    shell.points.push_back(point_of(hit, normal, role, code));
}

void add_points(const SurfaceVoxels& voxels, const Meridian& meridian, bool with_smooth, PointShell& shell) {
  for (int w = 0; w < voxels.dims.z(); ++w)
    for (int v = 0; v < voxels.dims.y(); ++v)
      for (int u = 0; u < voxels.dims.x(); u += 32)
        for (uint32_t bits = voxels.words[voxels.word_index(u, v, w)]; bits != 0; bits &= bits - 1)
          add_point(voxels, meridian, {u + std::countr_zero(bits), v, w}, with_smooth, shell);
}

ShellBlock block_of(const PointShell& shell, uint32_t first, uint32_t count) {
  Aabb box;
  for (uint32_t i = first; i < first + count; ++i) box.include(shell.surface_point_mm(shell.points[i]));
  ShellBlock block{first, count, box.centre().cast<float>(), 0.0f};
  double radius = 0.0;
  for (uint32_t i = first; i < first + count; ++i)
    radius =
        std::max(radius, (shell.surface_point_mm(shell.points[i]) - block.centre_mm.cast<double>()).norm());
  block.radius_mm = std::nextafter(static_cast<float>(radius), 1e30f);
  return block;
}

void add_blocks(PointShell& shell) {
  const auto count = static_cast<uint32_t>(shell.points.size());
  for (uint32_t first = 0; first < count;) {
    const uint64_t block = shell.points[first].morton >> block_bits;
    uint32_t end = first;
    while (end < count && shell.points[end].morton >> block_bits == block) ++end;
    shell.blocks.push_back(block_of(shell, first, end - first));
    first = end;
  }
}

}  // namespace

Vec3 PointShell::cell_centre_mm(uint64_t morton) const {
  const Vec3 cell(gather_bits(morton), gather_bits(morton >> 1), gather_bits(morton >> 2));
  return origin_mm + spacing_mm * (cell.array() + 0.5).matrix();
}

Vec3 PointShell::surface_point_mm(const ShellPoint& p) const {
  return cell_centre_mm(p.morton) + static_cast<double>(p.surface_offset_mm) * p.normal.cast<double>();
}

Aabb PointShell::bounds_mm() const {
  Aabb box;
  for (const ShellPoint& p : points) box.include(surface_point_mm(p));
  return box;
}

PointShell make_point_shell(const Tool& tool, double spacing_mm, bool with_smooth) {
  check_size(tool.profile, spacing_mm);
  const TriangleMesh mesh = fine_mesh(tool.profile, spacing_mm);
  SurfaceVoxels voxels = surface_grid(mesh, spacing_mm);
  voxelize_surface_cpu(mesh, Separability::six, voxels);

  PointShell shell;
  shell.spacing_mm = spacing_mm;
  shell.origin_mm = voxels.origin_mm;
  shell.dims = voxels.dims;
  add_points(voxels, Meridian(tool.profile, spacing_mm), with_smooth, shell);
  if (shell.points.empty())
    throw Error(ErrorKind::invalid_input, "tool \"" + tool.name + "\" gives no points at this spacing");
  std::sort(shell.points.begin(), shell.points.end(),
            [](const ShellPoint& a, const ShellPoint& b) { return a.morton < b.morton; });
  add_blocks(shell);
  return shell;
}

}  // namespace ream::shell
