#include "case/scapular_frame.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "core/error.hpp"

namespace ream::case_ {

FaceAngles ScapularFrame::angles_of(const Vec3& face_normal) const {
  const double lateral_part = face_normal.dot(lateral);
  return {-std::atan2(face_normal.dot(posterior), lateral_part),
          std::atan2(face_normal.dot(superior), lateral_part)};
}

Vec3 ScapularFrame::face_normal(const FaceAngles& angles) const {
  return (lateral + std::tan(angles.inclination_rad) * superior - std::tan(angles.version_rad) * posterior)
      .normalized();
}

ScapularFrame scapular_frame(const Vec3& glenoid_centre_mm, const Vec3& spine_root_mm,
                             const Vec3& inferior_angle_mm) {
  ScapularFrame frame;
  frame.lateral = (glenoid_centre_mm - spine_root_mm).normalized();
  frame.posterior = (spine_root_mm - glenoid_centre_mm).cross(inferior_angle_mm - glenoid_centre_mm);
  if (!(frame.posterior.norm() > 1e-9))
    throw Error(ErrorKind::invalid_input, "spine root, inferior angle and glenoid centre lie on one line");
  frame.posterior.normalize();
  if (frame.posterior.y() < 0.0) frame.posterior = -frame.posterior;
  frame.superior = frame.posterior.cross(frame.lateral);
  if (frame.superior.dot(glenoid_centre_mm - inferior_angle_mm) < 0.0) frame.superior = -frame.superior;
  return frame;
}

FaceAngles face_angles(const Vec3& face_normal, const Vec3& glenoid_centre_mm, const Vec3& spine_root_mm,
                       const Vec3& inferior_angle_mm) {
  return scapular_frame(glenoid_centre_mm, spine_root_mm, inferior_angle_mm).angles_of(face_normal);
}

}  // namespace ream::case_
