#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "force/coefficients.hpp"
#include "voxel/bone_model.hpp"

namespace ream {
class JsonReader;
}

namespace ream::case_ {

enum class Side { left, right };

/// A hole that exists before tick 0, along the plan's axis; outside all metrics.
struct PilotHole {
  double diameter_mm = 6.2;  ///< a little over the thesis reamer's 6 mm nipple
  double depth_mm = 12.0;    ///< below the entry point
};

/// What leads the reamer along the planned axis: nothing but the hand, its nipple in the pilot hole, or a pin
/// on which a cannulated reamer runs.
enum class GuideKind { none, nipple, pin };

/// Where and how to ream. World frame (LPS mm).
struct Plan {
  Vec3 entry_mm = Vec3::Zero();         ///< point of the axis on the native glenoid surface
  Vec3 axis_direction = Vec3::UnitX();  ///< unit, into the bone (medial)
  double depth_mm = 2.0;                ///< planned reaming depth past first contact of the cutting surface
  std::string reamer = "ellipse 18.25,9";  ///< profile text or path of a mesh, see shell/tool.hpp
  std::optional<PilotHole> pilot_hole = PilotHole{};
  GuideKind guide = GuideKind::none;             ///< nipple needs a pilot hole
  std::optional<double> implant_radius_mm = {};  ///< of the component's back
  std::string implant_size = {};                 ///< as its maker names it; "": not chosen
  /// What was aimed at (3D), kept so that scoring can compare; axis_direction decides.
  std::optional<double> target_version_rad = {}, target_inclination_rad = {};
  /// Taken in spite of a correction that reaming alone should not make (planning.hpp), and why.
  bool override_correction = false;
  std::string override_reason = {};
};

/// Glenoid coordinate system, world frame, each a unit vector; side-aware.
struct GlenoidFrame {
  Vec3 centre_mm = Vec3::Zero();
  Vec3 lateral = Vec3::UnitX(), superior = Vec3::UnitZ(), anterior = -Vec3::UnitY();
};

/// How HU became density; each law and number is kept with the case. Defaults are those of an
/// example phantom and of Schileo 2008.
struct Calibration {
  double intercept_mg_cc = 1.3152, slope_mg_cc_per_hu = 0.6944;  ///< rho_QCT = intercept + slope HU
  double threshold_hu = 200.0;                                   ///< segmentation threshold that was used
  std::string scanner = {};  ///< scanner or phantom that the first two were found with; "": none, the example
  std::string ash_law = "Schileo 2008";  ///< name of rho_ash = intercept + slope rho_QCT, g/cc
  double ash_intercept_g_cc = 0.079, ash_slope = 0.877;
  double ash_per_apparent = 0.598;  ///< rho_ash / apparent density (Schileo 2008)
};

struct Case {
  std::string id;      ///< folder name; [a-z0-9-]+
  std::string name;    ///< for people
  std::string source;  ///< where the volume came from, without patient names
  Side side = Side::right;
  voxel::BoneModel bone;
  Calibration calibration;
  std::optional<GlenoidFrame> glenoid;
  std::optional<Plan> plan;
  std::optional<force::CuttingCoefficients> cutting;  ///< how this bone is cut; empty: the default
  std::vector<std::string> warnings;
};

/// A case is a folder: case.json (proto/case.schema.json), plan.json where planned, density.zst and
/// coverage.zst (raw bytes in grid order, zstd). Saving is atomic: the folder appears whole or not at all.
/// Errors: not_found, invalid_input (names file and key), io.
Case load_case(const std::filesystem::path& folder);
/// The same with a density that is known already, of the size that case.json says.
Case load_case(const std::filesystem::path& folder, const voxel::SharedBytes& density);
/// Everything but the voxels: bone has its grid, density and coverage stay empty.
Case load_case_description(const std::filesystem::path& folder);
void save_case(const Case& c, const std::filesystem::path& folder, bool replace = false);
/// A new bone (and case.json) for the folder of a case; all else in it stays. The folder changes as a whole
/// or not at all.
void save_bone(const Case& c, const std::filesystem::path& folder);

/// Of what reaming decides by: grid, threshold, density and coverage. Equal cases have equal hashes on every
/// machine. Of a case as it was loaded, its pilot hole not cut. Takes about 2 ns a voxel.
uint64_t case_hash(const Case& c);

/// Replaces only the plan of an existing case.
void save_plan(const Plan& plan, const std::filesystem::path& case_folder);

/// Takes the plan's pilot hole out of the coverage (a cylinder from `clearance` before the entry to its
/// depth, sub-voxel at its border). Idempotent. Does nothing without a plan or hole.
void cut_pilot_hole(voxel::BoneModel& bone, const Plan& plan);

/// First bone surface met when moving along the plan's direction through `point` (coverage crosses 127.5);
/// empty when the ray misses the bone.
std::optional<Vec3> surface_along(const voxel::BoneModel& bone, const Vec3& point_mm, const Vec3& direction);

/// How far bone reaches along the direction from an entry on its surface, mm: to the far cortex, or to the
/// end of the grid. Empty when no bone lies within 2 mm of the entry on that line.
std::optional<double> bone_depth_along(const voxel::BoneModel& bone, const Vec3& entry_mm,
                                       const Vec3& direction);

std::string to_text(GuideKind guide);
/// Error invalid_input for other texts than none, nipple and pin; that of the reader names place and key.
GuideKind guide_from_text(const std::string& text);
GuideKind guide_from_json(JsonReader& reader);

/// What surfaces that are written say of themselves: "millimetres, LPS, right shoulder".
std::string frame_in_words(Side side);

std::string to_text(Side side);
/// Error invalid_input for other texts than left and right; that of the reader names place and key.
Side side_from_text(const std::string& text);
Side side_from_json(JsonReader& reader);

/// `calibration` of case.json (proto/case.schema.json). Only intercept, slope and threshold are needed; the
/// rest of the chain is that of Calibration's defaults where it is not given. Error invalid_input names place
/// and key: slopes and ratio must be over 0, so that the chain can be inverted.
Calibration calibration_from_json(const nlohmann::json& value, const std::string& place);
nlohmann::json to_json(const Calibration& calibration);

/// centre_mm, lateral, superior and anterior, as in case.json. Error invalid_input names place and key unless
/// the directions are unit vectors.
GlenoidFrame glenoid_from_json(JsonReader reader);
nlohmann::json to_json(const GlenoidFrame& frame);

}  // namespace ream::case_
