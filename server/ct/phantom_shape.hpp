#pragma once
#include "ct/phantom.hpp"

namespace ream::ct {

/// Geometry of the parametric right shoulder, world mm. A left shoulder is its mirror image in x = 0.
///
/// Scapular frame, origin at the glenoid centre: x lateral (from the spine root), y superior in the scapular
/// plane, z posterior. Face frame: origin the same, n lateral normal of the face, then superior and anterior
/// in the face. The vault is a pear-shaped prism seen along n, which narrows medially along -x to a neck and
/// spreads into the thin body; the articular surface is a sphere about centre + radius * n.
class PhantomShape {
 public:
  explicit PhantomShape(const PhantomParams& params);

  /// Signed distances (mm, negative in bone, first order: value over gradient). Exact at the articular
  /// surface.
  double scapula_mm(const Vec3& world_mm) const;
  double humerus_mm(const Vec3& world_mm) const;
  /// Depth under the articular sphere, mm; negative lateral of it.
  double depth_under_face_mm(const Vec3& world_mm) const;
  /// How far posterior of the glenoid centre a point lies, along the face, mm.
  double posterior_mm(const Vec3& world_mm) const;

  /// Right shoulder, before mirroring.
  GroundTruth truth() const;

 private:
  double scapula_value(const Vec3& world_mm) const;
  double body_value(const Vec3& offset) const;
  double processes_value(const Vec3& in_scapula) const;

  PhantomParams params_;
  Vec3 centre_, lateral_, superior_, posterior_;      // scapular frame
  Vec3 face_normal_, face_superior_, face_anterior_;  // face frame
  Vec3 medial_in_face_;                               // -lateral_ in (superior, anterior, normal) of the face
  Vec3 sphere_centre_, head_centre_;
};

}  // namespace ream::ct
