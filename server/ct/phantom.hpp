#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "case/case.hpp"
#include "ct/hu_volume.hpp"

namespace ream::ct {

/// A parametric shoulder. Lengths mm, angles rad (retroversion negative, superior inclination positive;
/// science 2.1). Typical values from science 2.4.
struct PhantomParams {
  case_::Side side = case_::Side::right;
  double version_rad = -0.0349;     ///< 2 degrees of retroversion
  double inclination_rad = 0.0733;  ///< 4.2 degrees superior
  double glenoid_radius_mm = 35.0;  ///< of the bony articular surface; 25 to 60
  double glenoid_height_mm = 37.5, glenoid_width_mm = 24.4;
  double scapular_plane_rad = 0.52;  ///< lateral axis turned anterior from the coronal plane
  double plate_mm = 1.9;             ///< subchondral plate
  double shell_mm = 1.2;             ///< cortical shell elsewhere
  double joint_space_mm = 4.0;       ///< bone to bone
  double noise_hu = 15.0;            ///< standard deviation
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
  double version_rad = 0, inclination_rad = 0;
  case_::GlenoidFrame glenoid;  ///< centre on the articular surface; lateral is the face normal
  Vec3 articular_sphere_centre_mm = Vec3::Zero();
  double articular_radius_mm = 0, glenoid_height_mm = 0, glenoid_width_mm = 0, plate_mm = 0;
  Vec3 spine_root_mm = Vec3::Zero(), inferior_angle_mm = Vec3::Zero();  ///< landmarks TS and AI
  Vec3 humeral_head_centre_mm = Vec3::Zero();
  double humeral_head_radius_mm = 0;
};

struct Phantom {
  HuVolume volume;
  GroundTruth truth;
};

/// Throws Error invalid_input for parameters out of range or a field without voxels. The same parameters give
/// the same voxels; a left phantom is the mirror image of the right one in x = 0, voxel for voxel.
Phantom make_phantom(const PhantomParams& params);

/// ground_truth.json; angles in degrees, lengths in mm.
nlohmann::json to_json(const GroundTruth& truth);

/// Version and inclination (rad; science 2.1) of a face normal (lateral) given the landmarks. The side
/// decides nothing but where posterior is: LPS +y.
struct FaceAngles {
  double version_rad = 0, inclination_rad = 0;
};
FaceAngles face_angles(const Vec3& face_normal, const Vec3& glenoid_centre_mm, const Vec3& spine_root_mm,
                       const Vec3& inferior_angle_mm);

}  // namespace ream::ct
