#pragma once
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/landmarks.hpp"
#include "ct/hu_volume.hpp"
#include "ct/phantom/anatomical_scapula.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ream::ct {

/// Kinds of glenoid (Walch where they are in his classes):
/// - a1: little worn, concentric;
/// - a2: worn in the centre: the face lies 4 mm medial and is nearly as curved as the head;
/// - b1: as a1, but the head has slid back and the joint space is narrow there;
/// - b2: biconcave. The anterior half is what is left of the face that was asked for, the posterior half a
///   neoglenoid turned 26 degrees further into retroversion, with a sclerotic zone of 4 mm under it and the
///   head subluxated into it;
/// - b3: one concave face, worn 9 mm medial and turned 18 degrees further into retroversion than was asked
///   for, to 16 degrees at least, sclerotic behind; the vault is what is left of the native one;
/// - c1: never grown in full: 25 degrees more retroverted than was asked for, 26 at least, without wear;
/// - d: 12 degrees less retroverted than was asked for, anteverted by 1 at least, the head slid forward;
/// - osteophytes: as a1, with osteophytes outside the lower half of the native rim;
/// - osteoporotic: as a1, with about two thirds of the densities and thinner plate and shell; a threshold of
///   100 HU keeps its spongy bone.
enum class PhantomType { a1, a2, b1, b2, b3, c1, d, osteophytes, osteoporotic };

/// "A1" to "D" as Walch writes them, "osteophytes", "osteoporotic". Error invalid_input for another word.
std::string to_text(PhantomType type);
PhantomType phantom_type_from_text(const std::string& text);
/// All words, in order.
std::vector<std::string> phantom_type_texts();

/// Of the humerus.
inline constexpr double mean_head_radius_mm = 24.0;

/// A parametric shoulder. Lengths mm, angles rad: retroversion negative, superior inclination
/// positive.
struct PhantomParams {
  case_::Side side = case_::Side::right;
  PhantomType type = PhantomType::a1;
  /// With it, body, acromion, coracoid and humerus look like a shoulder's; without, they are the simplest
  /// ones that a CT can be segmented with. Face, vault and neck are the same.
  std::optional<AnatomicalSizes> anatomical;
  double version_rad = -0.0349;     ///< 2 degrees of retroversion
  double inclination_rad = 0.0733;  ///< 4.2 degrees superior
  double glenoid_radius_mm = 35.0;  ///< of the bony articular surface; 25 to 60
  double glenoid_height_mm = 37.5, glenoid_width_mm = 24.4;
  double scapular_plane_rad = 0.52;  ///< lateral axis turned anterior from the coronal plane
  double plate_mm = 1.9;             ///< subchondral plate
  double shell_mm = 1.2;             ///< cortical shell elsewhere
  double joint_space_mm = 4.0;       ///< bone to bone
  double head_radius_mm = mean_head_radius_mm;
  double noise_hu = 15.0;  ///< standard deviation
  uint64_t random_seed = 1;
  Vec3 spacing_mm{0.668, 0.668, 0.625};
  /// The volume's box about the glenoid centre for a right shoulder, LPS (medial is +x, anterior -y); a left
  /// one is mirrored in x. Its size is rounded to whole voxels.
  Aabb field_mm{{-60.0, -55.0, -115.0}, {100.0, 65.0, 50.0}};
  case_::Calibration calibration;
};

/// What is exactly true of the phantom; world frame (LPS mm).
struct GroundTruth {
  case_::Side side = case_::Side::right;
  PhantomType type = PhantomType::a1;
  /// Of the face as it is (3D); of a biconcave one along its intermediate line.
  double version_rad = 0, inclination_rad = 0;
  /// As it was asked for, before the wear of a biconcave or a B3 glenoid. Of a biconcave one: along the
  /// paleoglenoid's chord (anterior rim to ridge); along the neoglenoid's.
  std::optional<double> premorbid_version_rad, paleo_version_rad, neo_version_rad;
  case_::GlenoidFrame glenoid;  ///< centre on the articular surface; lateral is the face normal
  Vec3 articular_sphere_centre_mm = Vec3::Zero();
  double articular_radius_mm = 0, plate_mm = 0;
  double glenoid_height_mm = 0, glenoid_width_mm = 0;                   ///< before any wear
  Vec3 spine_root_mm = Vec3::Zero(), inferior_angle_mm = Vec3::Zero();  ///< landmarks TS and AI
  Vec3 humeral_head_centre_mm = Vec3::Zero();
  double humeral_head_radius_mm = 0;
  case_::Landmarks landmarks;  ///< all of them where they belong, on native bone
};

struct Phantom {
  HuVolume volume;
  GroundTruth truth;
};

/// Throws Error invalid_input for parameters out of range or a field without voxels. The same parameters give
/// the same voxels; a left phantom is the mirror image of the right one in x = 0, voxel for voxel.
Phantom make_phantom(const PhantomParams& params);

/// HuVolume::source of such a phantom, which its cases keep.
std::string phantom_source(const PhantomParams& params);

/// Apparent density at points of the world, g/cc, before voxels, noise and partial volume; 0 outside the
/// scapula. The phantom's densities are exact but within a voxel of a border between tissues.
std::function<double(const Vec3& world_mm)> true_density_g_cc(const PhantomParams& params);

/// The scapula's surface in the whole field, LPS mm, outward normals, sampled at cubes of that size: for
/// pictures. Errors as make_phantom.
TriangleMesh scapula_surface(const PhantomParams& params, double sample_mm);

/// ground_truth.json; angles in degrees, lengths in mm.
nlohmann::json to_json(const GroundTruth& truth);

}  // namespace ream::ct
