#include "bench/validate/density_measures.hpp"

#include <cmath>
#include <vector>

#include "bench/validate/statistics.hpp"
#include "voxel/solid_cells.hpp"

namespace ream::bench {
namespace {

constexpr double about_middle_mm = 0.25, from_compact_mm = 3.0, from_plate_mm = 5.0;
constexpr double joint_from_mm = 1.0, joint_to_mm = 3.0, middle_of_face_mm = 8.0;

/// Mean place of the face along lines parallel to its normal: where the coverage crosses its middle.
double surface_off_mm(const test::AnalyticGlenoid& glenoid, const voxel::BoneModel& bone) {
  constexpr double lattice_mm = 0.5, from_mm = 1.8, step_mm = 0.02, level = 127.5;
  const test::AnalyticGlenoid::Frame face = glenoid.frame();
  const Pose grid_from_world = bone.grid.world_from_grid.inverse();
  std::vector<double> off_mm;
  for (double up = -middle_of_face_mm; up <= middle_of_face_mm; up += lattice_mm)
    for (double front = -middle_of_face_mm; front <= middle_of_face_mm; front += lattice_mm) {
      const double square = up * up + front * front;
      if (square > middle_of_face_mm * middle_of_face_mm) continue;
      const double lateral = glenoid.radius_mm - std::sqrt(glenoid.radius_mm * glenoid.radius_mm - square);
      for (double out = from_mm; out > -from_mm; out -= step_mm) {
        const Vec3 at = face.centre + up * face.superior + front * face.anterior + (lateral + out) * face.n;
        if (voxel::coverage_at(bone, grid_from_world.point(glenoid.mirrored(at))) < level) continue;
        off_mm.push_back(out);
        break;
      }
    }
  return mean(off_mm);
}

}  // namespace

DensityMeasures measured_density(const test::AnalyticGlenoid& glenoid, const voxel::BoneModel& bone) {
  const test::GlenoidFormulas formulas(glenoid);
  const test::AnalyticGlenoid::Frame face = glenoid.frame();
  std::vector<double> plate, shell, core;
  size_t joint = 0, joint_bone = 0;
  for (size_t i = 0; i < bone.coverage.size(); ++i) {
    const Vec3 at = bone.grid.world_from_grid.point(bone.grid.centre_mm(bone.grid.coordinates(i)));
    const double depth_mm = formulas.depth_mm(at), in_wall_mm = -formulas.beyond_wall_mm(at);
    if (in_wall_mm < 0.0) continue;
    const Vec3 offset = glenoid.mirrored(at) - face.centre;
    if (depth_mm < 0.0) {
      const bool counts = depth_mm < -joint_from_mm && depth_mm > -joint_to_mm &&
                          (offset - offset.dot(face.n) * face.n).norm() < middle_of_face_mm;
      joint += counts;
      joint_bone += counts && bone.coverage[i] >= voxel::solid_coverage;
      continue;
    }
    const double left_mm = glenoid.vault_mm + offset.dot(face.n);  // to the vault's end
    if (bone.coverage[i] < voxel::solid_coverage || left_mm < from_compact_mm) continue;
    const double density = voxel::density_g_cc(bone.density[i]);
    const bool in_core = in_wall_mm > glenoid.shell_mm + from_compact_mm;
    if (in_core && std::abs(depth_mm - 0.5 * glenoid.plate_mm) < about_middle_mm) plate.push_back(density);
    if (in_core && depth_mm > glenoid.plate_mm + from_compact_mm) core.push_back(density);
    if (depth_mm > from_plate_mm && std::abs(in_wall_mm - 0.5 * glenoid.shell_mm) < about_middle_mm)
      shell.push_back(density);
  }
  return {mean(plate),
          mean(shell),
          mean(core),
          deviation(core),
          joint == 0 ? 0.0 : 100.0 * static_cast<double>(joint_bone) / static_cast<double>(joint),
          surface_off_mm(glenoid, bone)};
}

}  // namespace ream::bench
