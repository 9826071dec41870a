#include "case/two_plates.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/hash.hpp"

namespace ream::case_ {
namespace {

constexpr std::string_view id_prefix = "two-plates-";

constexpr double voxel_mm = 0.3;
/// Of the hollow: a little over the 37 mm of the reamer's tip (ellipse 18.25,9), so that the tip leads it in.
constexpr double hollow_radius_mm = 38.0;
constexpr double plate_radius_mm = 19.3, plate_centre_mm = plate_radius_mm;
constexpr double rim_height_mm = 5.2;  ///< over the bottom of the hollow
/// Beyond it a plate is wall: the reamer, of 18.25 mm, touches it only when it leaves the hollow.
constexpr double hollow_edge_mm = 18.6;
constexpr double base_top_mm = -9.0, bottom_mm = -12.0;
/// Fills the corners between the plates.
constexpr double bridge_half_width_mm = 10.0, bridge_half_height_mm = 4.0;
/// Air all around, and a plane between two voxels in the middle, so that both plates are the same.
const Vec3i dims(72, 136, 264);

constexpr uint8_t cartilage = voxel::cartilage_code;
/// Codes are hundredths of g/cc. Within what the thesis measured: cancellous bone 0.41 to 0.72, cortical bone
/// 1.30 to 1.61 g/cc.
constexpr uint8_t cortical = 145, thin_cortical = 130, cancellous = 55, light = 45, dense = 65, wall = light;

constexpr double to_bottom_mm = 1000.0;

/// How far below the hollow's surface of a plate (z of its centre), mm; negative over it.
double depth_mm(const Vec3& p, double plate_z_mm) {
  return (p - Vec3(hollow_radius_mm, 0.0, plate_z_mm)).norm() - hollow_radius_mm;
}

/// From the middle of a plate, across its axis.
double off_centre_mm(const Vec3& p, double plate_z_mm) {
  const double z = p.z() - plate_z_mm;
  return std::sqrt(p.y() * p.y() + z * z);
}

double box_distance_mm(const Vec3& p, double top_mm, double half_width_mm, double half_height_mm) {
  return std::max(
      {p.x() - top_mm, bottom_mm - p.x(), std::abs(p.y()) - half_width_mm, std::abs(p.z()) - half_height_mm});
}

/// From the surface of it all, mm; negative in bone. Near a hollow exact, elsewhere at most the distance.
double distance_mm(const Vec3& p, double plate_z_mm) {
  const double plate_mm =
      std::max({p.x() - rim_height_mm, bottom_mm - p.x(), off_centre_mm(p, plate_z_mm) - plate_radius_mm});
  const double bridge_mm = box_distance_mm(p, rim_height_mm, bridge_half_width_mm, bridge_half_height_mm);
  const double base_mm = box_distance_mm(p, base_top_mm, plate_radius_mm, plate_centre_mm + plate_radius_mm);
  return std::min(std::max(-depth_mm(p, plate_z_mm), std::min(plate_mm, bridge_mm)), base_mm);
}

uint8_t code_at(const Vec3& p, double plate_z_mm, const std::vector<PlateLayer>& layers) {
  if (off_centre_mm(p, plate_z_mm) > hollow_edge_mm) return wall;
  double depth = depth_mm(p, plate_z_mm);
  for (const PlateLayer& layer : layers) {
    if (depth < layer.thickness_mm) return layer.code;
    depth -= layer.thickness_mm;
  }
  return layers.back().code;
}

voxel::BoneModel bone_of(const std::vector<PlateLayer>& upper, const std::vector<PlateLayer>& lower) {
  voxel::VoxelGrid grid;
  grid.dims = dims;
  grid.spacing_mm = Vec3::Constant(voxel_mm);
  const Vec3 low(bottom_mm - 4 * voxel_mm, -0.5 * dims.y() * voxel_mm, -0.5 * dims.z() * voxel_mm);
  grid.world_from_grid.translation_mm = low;
  voxel::BoneModel bone = voxel::make_bone(grid);
  std::vector<uint8_t>& density = bone.density.writable();
  for (size_t i = 0; i < grid.voxel_count(); ++i) {
    const Vec3 p = low + grid.centre_mm(grid.coordinates(i));
    const double plate_z_mm = p.z() > 0.0 ? plate_centre_mm : -plate_centre_mm;
    const double level = 127.5 - 255.0 * distance_mm(p, plate_z_mm) / voxel_mm;
    bone.coverage[i] = static_cast<uint8_t>(std::clamp(level, 0.0, 255.0));
    if (bone.coverage[i] > 0) density[i] = code_at(p, plate_z_mm, p.z() > 0.0 ? upper : lower);
  }
  return bone;
}

/// Comparison and whether the plate that is asked for is the upper one, by the case's id.
std::pair<const PlateComparison*, bool> comparison_of(std::string_view case_id) {
  for (const PlateComparison& comparison : plate_comparisons())
    for (const bool upper : {true, false})
      if (two_plates_id(comparison.id, upper) == case_id) return {&comparison, upper};
  throw Error(ErrorKind::not_found, "no case '" + std::string(case_id) + "'");
}

}  // namespace

const std::vector<PlateComparison>& plate_comparisons() {
  static const std::vector<PlateComparison> all = {
      {"cartilage",
       "Which plate begins with cartilage?",
       {{2.0, cartilage}, {2.0, cortical}, {to_bottom_mm, cancellous}},
       {{2.0, cortical}, {to_bottom_mm, cancellous}}},
      {"bone_under_cartilage",
       "Both plates begin with cartilage. On which one does the reamer come to bone?",
       {{2.0, cartilage}, {to_bottom_mm, cortical}},
       {{to_bottom_mm, cartilage}}},
      {"through_plate",
       "Both plates begin with hard bone. On which one does the reamer break through into soft bone?",
       {{0.6, thin_cortical}, {to_bottom_mm, cancellous}},
       {{to_bottom_mm, thin_cortical}}},
      {"density",
       "Both plates are of soft bone. Which one is the denser?",
       {{to_bottom_mm, dense}},
       {{to_bottom_mm, light}}}};
  return all;
}

const PlateComparison* find_plate_comparison(std::string_view id) {
  for (const PlateComparison& comparison : plate_comparisons())
    if (comparison.id == id) return &comparison;
  return nullptr;
}

std::string two_plates_id(std::string_view comparison, bool asked_for_is_upper) {
  if (find_plate_comparison(comparison) == nullptr)
    throw Error(ErrorKind::not_found, "no comparison of plates '" + std::string(comparison) + "'");
  const std::string said = std::string(comparison) + (asked_for_is_upper ? " upper" : " lower");
  return std::string(id_prefix) + to_hex(hash_text(said)).substr(0, 8);
}

bool is_two_plates(std::string_view case_id) { return case_id.starts_with(id_prefix); }

Case make_two_plates(const std::string& case_id) {
  const auto [comparison, upper] = comparison_of(case_id);
  Case made;
  made.id = case_id;
  made.name = "Two plates";
  made.source = "made for studies of feel";
  made.bone = upper ? bone_of(comparison->asked_for, comparison->other)
                    : bone_of(comparison->other, comparison->asked_for);
  Plan plan;
  plan.entry_mm = Vec3(rim_height_mm, 0.0, 0.0);
  plan.axis_direction = -Vec3::UnitX();
  plan.depth_mm = 8.0;
  plan.reamer = "ellipse 18.25,9";
  plan.pilot_hole = std::nullopt;
  made.plan = plan;
  return made;
}

std::filesystem::path two_plates_folder(const std::filesystem::path& data_folder,
                                        const std::string& case_id) {
  return data_folder / "plates" / case_id;
}

void keep_two_plates(const std::filesystem::path& data_folder, const std::string& case_id) {
  const auto folder = two_plates_folder(data_folder, case_id);
  if (std::filesystem::exists(folder / "case.json")) return;
  std::filesystem::create_directories(folder.parent_path());
  save_case(make_two_plates(case_id), folder, true);
}

}  // namespace ream::case_
