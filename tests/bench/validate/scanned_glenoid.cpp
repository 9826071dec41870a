#include "bench/validate/scanned_glenoid.hpp"

#include "bench/validate/published_density.hpp"
#include "ct/build/import.hpp"
#include "support/temporary_folder.hpp"

namespace ream::bench {
namespace {

constexpr double head_radius_mm = 24.0, head_shell_mm = 1.0, joint_space_mm = 4.0;
constexpr double head_shell_g_cc = 1.2, head_spongy_g_cc = 0.35;
constexpr double click_depth_mm = 8.0;
/// What is scanned: so far behind the vault, lateral of the glenoid's centre, up and down, to the front and
/// back.
constexpr double behind_vault_mm = 3.0, lateral_mm = 34.0, up_mm = 22.0, front_mm = 18.0;

Vec3 head_centre_mm(const test::AnalyticGlenoid& glenoid) {
  const test::AnalyticGlenoid::Frame face = glenoid.frame();
  return glenoid.mirrored(face.centre + (joint_space_mm + head_radius_mm) * face.n);
}

Aabb field_of(const test::AnalyticGlenoid& glenoid) {
  const test::AnalyticGlenoid::Frame face = glenoid.frame();
  Aabb field;
  for (const double out : {-glenoid.vault_mm - behind_vault_mm, lateral_mm})
    for (const double up : {-up_mm, up_mm})
      for (const double front : {-front_mm, front_mm})
        field.include(
            glenoid.mirrored(face.centre + out * face.n + up * face.superior + front * face.anterior));
  return field;
}

}  // namespace

voxel::BoneModel imported_bone(const Scan& scan, case_::Side side, const Vec3& in_scapula_mm,
                               const std::optional<Vec3>& in_humerus_mm, int upsample) {
  const test::TemporaryFolder folder;
  write_nrrd(scan, folder.path() / "scan.nrrd");
  ct::ImportOptions options;
  options.side = side;
  options.segmentation.seeds.scapula_mm = in_scapula_mm;
  options.segmentation.seeds.humerus_mm = in_humerus_mm;
  options.build.around_glenoid = false;
  options.build.upsample = upsample;
  return ct::import_ct(folder.path() / "scan.nrrd", "scan", options).made.bone;
}

voxel::BoneModel imported_bone(const ScannedGlenoid& scanned) {
  const test::AnalyticGlenoid& glenoid = scanned.glenoid;
  const test::GlenoidFormulas formulas(glenoid);
  const Vec3 head = head_centre_mm(glenoid);
  const double head_shell_hu = published_hu(head_shell_g_cc), head_spongy_hu = published_hu(head_spongy_g_cc);
  const auto true_hu = [&](const Vec3& world_mm) {
    const double in_head_mm = head_radius_mm - (world_mm - head).norm();
    if (in_head_mm > 0.0) return in_head_mm < head_shell_mm ? head_shell_hu : head_spongy_hu;
    return formulas.solid(world_mm) ? published_hu(formulas.density_g_cc(world_mm)) : soft_tissue_hu;
  };
  const Scan scan = take_scan(true_hu, field_of(glenoid), scanned.protocol, scanned.seed);
  const test::AnalyticGlenoid::Frame face = glenoid.frame();
  const Vec3 vault = glenoid.mirrored(face.centre - click_depth_mm * face.n);
  return imported_bone(scan, glenoid.shoulder.side, vault, head, scanned.upsample);
}

}  // namespace ream::bench
