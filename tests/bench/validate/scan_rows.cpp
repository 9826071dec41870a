#include <array>
#include <cmath>
#include <span>
#include <sstream>
#include <vector>

#include "bench/text_table.hpp"
#include "bench/validate/density_measures.hpp"
#include "bench/validate/parallel.hpp"
#include "bench/validate/plate_measures.hpp"
#include "bench/validate/published_density.hpp"
#include "bench/validate/scanned_glenoid.hpp"
#include "bench/validate/validate_parts.hpp"
#include "statistics/sample.hpp"

namespace ream::bench {
namespace {

/// A protocol, and how near to the truth the share of plate preserved must come. Where a pixel is no wider
/// than the blur, the import puts the face 0.1 mm outside (bone_from_mask says so), which is worth ten
/// points.
struct JudgedProtocol {
  ScanProtocol scan;
  double preserved_goal_points;
};
constexpr JudgedProtocol coarse_protocols[] = {{{"0.6 x 1.25 mm", 0.6, 1.25}, 5.0}};
constexpr JudgedProtocol fine_protocols[] = {{{"0.3 x 0.6 mm", 0.3, 0.6}, 10.0},
                                             {{"0.4 x 0.625 mm", 0.4, 0.625}, 5.0}};
constexpr uint64_t first_scan_seed = 100;
constexpr std::array judged_plates_mm{0.6, 1.2, 1.9, 2.9};
/// From here on a plate's middle is not blurred away: three times the blur's width at half maximum.
constexpr double visible_plate_mm = 1.9;

/// Half a step of density's codes.
constexpr double core_goal_g_cc = 0.005;
/// Changes cortical feed at 1.5 g/cc by 7 %, which is what a hand can just feel of a force.
constexpr double plate_goal_g_cc = 0.05;
constexpr double joint_goal_percent = 0.1, surface_goal_mm = 0.15;
/// A twentieth of a plate.
constexpr double thickness_goal_mm = 0.1;
constexpr double inner_border_goal_mm = 0.06;
/// The lower limit of the rubric: more would take points from a session without a fault.
constexpr double lost_goal_points = 10.0;

struct MeasuredScan {
  DensityMeasures density;
  PlateMeasures plate, truth;
};

MeasuredScan measure_scan(const ScannedGlenoid& scanned) {
  const voxel::BoneModel bone = imported_bone(scanned);
  return {measured_density(scanned.glenoid, bone), measured_plate(scanned.glenoid, bone),
          true_plate(scanned.glenoid)};
}

/// A name for people: "glenoid, 0.4 x 0.625 mm scan, plate of 1.9 mm".
std::string scan_name(const ScannedGlenoid& scanned) {
  std::ostringstream name;
  name << "CT, " << scanned.protocol.name << " scan, plate of " << scanned.glenoid.plate_mm << " mm";
  return name.str();
}

/// No goal where CT cannot show it.
void add_density(const ScannedGlenoid& scanned, const DensityMeasures& m, std::vector<Row>& rows) {
  const bool visible = scanned.glenoid.plate_mm >= visible_plate_mm;
  const std::string name = scan_name(scanned) + ", ";
  rows.push_back({"validate", name + "its density off the true",
                  std::abs(m.plate_g_cc - scanned.glenoid.compact_g_cc), 0.0, "g/cc",
                  visible ? plate_goal_g_cc : 0.0});
  if (scanned.glenoid.plate_mm != visible_plate_mm) return;
  rows.push_back({"validate", name + "density of spongy bone off the true",
                  std::abs(m.core_g_cc - scanned.glenoid.spongy_g_cc), 0.0, "g/cc", core_goal_g_cc});
  rows.push_back({"validate", name + "density of a 1.2 mm shell off the true",
                  std::abs(m.shell_g_cc - scanned.glenoid.compact_g_cc), 0.0, "g/cc", 0.0});
  rows.push_back({"validate", name + "of the joint's space taken for bone", m.joint_bone_percent, 0.0, "%",
                  joint_goal_percent});
  rows.push_back(
      {"validate", name + "face off its place", std::abs(m.surface_mm), 0.0, "mm", surface_goal_mm});
}

void add_plate(const ScannedGlenoid& scanned, double preserved_goal_points, const MeasuredScan& m,
               std::vector<Row>& rows) {
  const bool visible = scanned.glenoid.plate_mm >= visible_plate_mm;
  const std::string name = scan_name(scanned) + ", ";
  const auto row = [&](const char* what, double off, const char* unit, double goal) {
    rows.push_back({"validate", name + what, std::abs(off), 0.0, unit, visible ? goal : 0.0});
  };
  const double thicker_mm = m.plate.thickness_mm - m.truth.thickness_mm;
  row("plate_thickness_mm off", thicker_mm, "mm", thickness_goal_mm);
  if (!visible) return;
  row("its inner border off its place", thicker_mm - m.density.surface_mm, "mm", inner_border_goal_mm);
  row("plate_preserved_percent off", m.plate.preserved_percent - m.truth.preserved_percent, "points",
      preserved_goal_points);
  row("plate_lost_percent off", m.plate.lost_percent - m.truth.lost_percent, "points", lost_goal_points);
}

void print_scans(const std::vector<ScannedGlenoid>& scans, const std::vector<MeasuredScan>& measured,
                 std::ostream* out) {
  TextTable density, plate;
  density.title = "Density through CT, g/cc (true: compact 1.5, spongy 0.56), noise of 20 HU, blur of 0.7 mm";
  density.corner = "scan";
  density.columns = {"plate", "shell", "spongy", "its SD", "joint %", "face mm"};
  plate.title = "Subchondral plate through CT, reamed to its middle: measured and true";
  plate.corner = "scan";
  plate.columns = {"mm", "true", "kept %", "true", "planned %", "true", "lost %", "true"};
  for (size_t i = 0; i < scans.size(); ++i) {
    const MeasuredScan& m = measured[i];
    density.lines.push_back(
        {scan_name(scans[i]),
         {m.density.plate_g_cc, m.density.shell_g_cc, m.density.core_g_cc, m.density.core_deviation_g_cc,
          m.density.joint_bone_percent, m.density.surface_mm}});
    plate.lines.push_back(
        {scan_name(scans[i]),
         {m.plate.thickness_mm, m.truth.thickness_mm, m.plate.preserved_percent, m.truth.preserved_percent,
          m.plate.planned_percent, m.truth.planned_percent, m.plate.lost_percent, m.truth.lost_percent}});
  }
  density.print(out, 3);
  plate.print(out, 2);
}

/// Bars of every HU from 0 to 2000, imported without noise or blur: the mean over them all sees a thousandth
/// of a code's step.
Row wedge_row() {
  constexpr int highest_hu = 2000, across = 9;
  Scan wedge;
  wedge.dims = {highest_hu + 1, across, across};
  wedge.spacing_mm = Vec3::Constant(0.5);
  wedge.corner_mm = Vec3::Zero();
  for (int w = 0; w < across; ++w)
    for (int v = 0; v < across; ++v)
      for (int hu = 0; hu <= highest_hu; ++hu) wedge.hu.push_back(static_cast<int16_t>(hu));
  const double middle_mm = 0.25 * across;
  const voxel::BoneModel bone =
      imported_bone(wedge, case_::Side::right, Vec3(0.5 * 1500.0, middle_mm, middle_mm), std::nullopt, 1);
  constexpr int from_hu = 500;  // well within what is segmented as bone
  const Pose grid_from_world = bone.grid.world_from_grid.inverse();
  std::vector<double> off;
  for (int hu = from_hu; hu < highest_hu; ++hu) {
    const Vec3i voxel =
        bone.grid.voxel_at(grid_from_world.point(Vec3(0.5 * hu + 0.25, middle_mm, middle_mm)));
    off.push_back(voxel::density_g_cc(bone.density[bone.grid.index(voxel)]) - published_density_g_cc(hu));
  }
  constexpr double goal_g_cc = 5e-5;
  return {"validate",
          "CT, bars of 500 to 2000 HU, mean density off the published relation",
          std::abs(statistics::mean_of(off)),
          0.0,
          "g/cc",
          goal_g_cc};
}

/// A plate that CT does not show is taken as published.
Row hidden_plate_row() {
  ScannedGlenoid scanned;
  scanned.glenoid.compact_g_cc = scanned.glenoid.spongy_g_cc = 0.9;
  scanned.protocol = coarse_protocols[0].scan;
  const double said_mm = measured_plate(scanned.glenoid, imported_bone(scanned)).thickness_mm;
  return {"validate",
          "CT, a plate as dense as what is under it, plate_thickness_mm off the published 1.9",
          std::abs(said_mm - published_plate_mm),
          0.0,
          "mm",
          0.01};
}

/// Rows of these protocols' scans, and their tables.
std::vector<Row> rows_of_scans(std::span<const JudgedProtocol> protocols, const Options& options) {
  std::vector<ScannedGlenoid> scans;
  for (const JudgedProtocol& protocol : protocols)
    for (const double plate_mm : judged_plates_mm) {
      ScannedGlenoid& scanned = scans.emplace_back();
      scanned.glenoid.plate_mm = plate_mm;
      scanned.protocol = protocol.scan;
      scanned.seed = first_scan_seed + scans.size();
    }
  std::vector<MeasuredScan> measured(scans.size());
  in_parallel(scans.size(), [&](size_t i) { measured[i] = measure_scan(scans[i]); });
  std::vector<Row> rows;
  for (size_t i = 0; i < scans.size(); ++i) {
    add_density(scans[i], measured[i].density, rows);
    add_plate(scans[i], protocols[i / judged_plates_mm.size()].preserved_goal_points, measured[i], rows);
  }
  print_scans(scans, measured, options.tables);
  return rows;
}

}  // namespace

std::vector<Row> scan_rows(const Options& options) {
  std::vector<Row> rows = rows_of_scans(coarse_protocols, options);
  rows.push_back(wedge_row());
  rows.push_back(hidden_plate_row());
  return rows;
}

std::vector<Row> fine_scan_rows(const Options& options) { return rows_of_scans(fine_protocols, options); }

}  // namespace ream::bench
