#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/landmarks.hpp"

namespace ream::case_ {

/// Version and inclination of a face, rad; retroversion negative, superior inclination positive.
struct FaceAngles {
  double version_rad = 0, inclination_rad = 0;
};

/// Scapular coordinate system, world frame, each a unit vector: lateral from the root of the
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

/// A biconcave (B2) glenoid: 3D versions of its two concavities and of the intermediate line from the
/// anterior edge of the one to the posterior edge of the other (Rouleau 2010), and the angle between both
/// concavities.
struct Biconcavity {
  double paleo_version_rad = 0, neo_version_rad = 0, intermediate_version_rad = 0, between_rad = 0;
};

/// What landmarks say about a glenoid. Angles rad; retroversion negative, superior inclination positive. A
/// measure whose landmarks are missing is empty.
///
/// 3D: against the plane of trigonum, inferior angle and glenoid centre; see
/// ScapularFrame. Unchanged by moving or scaling all points, and by turning them as long as posterior
/// stays LPS +y.
///
/// Friedman 2D: version in the axial plane (LPS x, y: every point is projected along z): angle between the
/// line of the anterior and posterior rim and the perpendicular to the axis from the trigonum to the middle
/// of that line. Friedman defines no inclination: the other one is in the upright plane (a coronal image)
/// through trigonum and middle of the superior-inferior rim line, spanned by LPS z. Both are (angle at the
/// middle of the rim line from the trigonum to the posterior, or inferior, rim) - 90 degrees. Unchanged by
/// moving and scaling and by turning about z only: how the patient lay in the scanner decides too, as in
/// Friedman's slices.
struct Measures {
  std::optional<double> version_3d_rad, inclination_3d_rad;
  std::optional<double> version_friedman_rad, inclination_friedman_rad;
  /// Share of the humeral head's diameter that lies posterior of the scapular plane: 50 + 50 d / r, where d
  /// is how far its centre lies posterior of that plane; 0 to 100, 50 is centred. This is the index a / D of
  /// Walch and the one of his later classes; it grows with retroversion even of a head centred on its
  /// face.
  std::optional<double> subluxation_percent;
  /// The same against the plane through the glenoid centre across the anterior-posterior rim line: how far
  /// the head has left its face.
  std::optional<double> subluxation_glenoid_percent;
  std::optional<Biconcavity> biconcavity;
  std::vector<std::string> missing;  ///< landmarks that empty measures need, by their keys in landmarks.json
};

/// Where a biconcavity is marked, its intermediate line stands for the anterior-posterior rim line
/// everywhere. Error invalid_input when landmarks coincide or lie on one line, or are those of the other
/// shoulder.
Measures measure(const Landmarks& landmarks, Side side);

/// Angles in degrees, empty ones null; `normal` with the values of healthy shoulders and their sources, and
/// `words` for people ("12.0° retroversion", never a bare sign).
nlohmann::json to_json(const Measures& measures);
nlohmann::json degrees_or_null(const std::optional<double>& rad);

/// "12.0° retroversion", "3.0° anteversion", "0.0° version" and "4.0° superior", "2.0° inferior", "0.0°
/// inclination".
std::string version_in_words(double version_rad);
std::string inclination_in_words(double inclination_rad);

/// Centre, face normal and directions in the face. Error invalid_input names the landmarks that are missing
/// (glenoid centre and the four rim points) or contradict each other.
GlenoidFrame glenoid_frame(const Landmarks& landmarks, Side side);

}  // namespace ream::case_
