#pragma once
#include "case/case.hpp"

namespace ream::case_ {

/// Version and inclination of a face, rad; retroversion negative, superior inclination positive.
struct FaceAngles {
  double version_rad = 0, inclination_rad = 0;
};

/// Scapular coordinate system, world frame, each a unit vector (science 2.1): lateral from the root of the
/// spine to the glenoid centre, posterior across the plane of both and the inferior angle, superior in that
/// plane. Posterior is the patient's (LPS +y), whatever the order of the points.
struct ScapularFrame {
  Vec3 lateral = Vec3::UnitX(), superior = Vec3::UnitZ(), posterior = Vec3::UnitY();

  /// version = -atan2(n posterior, n lateral), inclination = atan2(n superior, n lateral); n of any length.
  FaceAngles angles_of(const Vec3& face_normal) const;
  /// The unit normal, lateral, of a face with these angles; each below a right angle.
  Vec3 face_normal(const FaceAngles& angles) const;
};

/// Error invalid_input when the three points lie on one line.
ScapularFrame scapular_frame(const Vec3& glenoid_centre_mm, const Vec3& spine_root_mm,
                             const Vec3& inferior_angle_mm);

/// The angles of a face normal in the frame of those landmarks.
FaceAngles face_angles(const Vec3& face_normal, const Vec3& glenoid_centre_mm, const Vec3& spine_root_mm,
                       const Vec3& inferior_angle_mm);

}  // namespace ream::case_
