#pragma once
#include "ct/phantom/anatomical_scapula.hpp"
#include "ct/phantom/phantom.hpp"

namespace ream::ct {

/// Second concavity of a biconcave glenoid: a sphere that cuts the face from the ridge to the posterior rim.
struct Neoglenoid {
  Vec3 sphere_centre_mm = Vec3::Zero(), normal = Vec3::UnitX();
  double radius_mm = 0;
};

/// Geometry of the parametric right shoulder, world mm. A left shoulder is its mirror image in x = 0.
///
/// Scapular frame, origin at the glenoid centre: x lateral (from the spine root), y superior in the scapular
/// plane, z posterior. Face frame: origin the same, n lateral normal of the face, then superior and anterior
/// in the face. The vault is a pear-shaped prism seen along the native face's n, which narrows medially along
/// -x to a neck and spreads into the thin body; the articular surface is a sphere about centre + radius * n.
/// Wear moves the centre medially along -x, so that the scapular axis stays what it is, and may turn n.
class PhantomShape {
 public:
  /// The widest level lies below the middle by this share of the height (0.64 L from the superior pole).
  static constexpr double widest_below_middle = 0.14;

  explicit PhantomShape(const PhantomParams& params);

  /// Signed distances (mm, negative in bone, first order: value over gradient). Exact at the articular
  /// surface.
  double scapula_mm(const Vec3& world_mm) const;
  double humerus_mm(const Vec3& world_mm) const;
  /// The scapula's surface beside a point that lies within a millimetre of it.
  Vec3 on_scapula(const Vec3& near_mm) const;
  /// Depth under the articular surface, mm; negative lateral of it.
  double depth_under_face_mm(const Vec3& world_mm) const;
  /// Depth under the neoglenoid's sphere, mm; far from it without one.
  double depth_under_neoglenoid_mm(const Vec3& world_mm) const;
  /// In acromion, coracoid or spine of an anatomical scapula rather than in its vault or body.
  bool is_process(const Vec3& world_mm) const;
  /// Posterior of the middle of the face as it is.
  bool is_behind_middle(const Vec3& world_mm) const;
  /// How far posterior of the glenoid centre a point lies, along the face, mm.
  double posterior_mm(const Vec3& world_mm) const;

  /// Right shoulder, before mirroring.
  GroundTruth truth() const;

 private:
  /// What makes the scapula at a place near its surface, and within the gradient's step of it: `body` or
  /// `processes` where the other is too far off to count.
  enum class MadeBy { both, body, processes };
  struct ScapulaValue {
    double value;
    MadeBy made_by;
  };
  ScapulaValue scapula_value(const Vec3& world_mm) const;
  double scapula_value(const Vec3& world_mm, MadeBy made_by) const;
  Vec3 scapula_gradient(const Vec3& world_mm, MadeBy made_by) const;
  double body_with_osteophytes_value(const Vec3& world_mm) const;
  double processes_beside_humerus_value(const Vec3& world_mm, double body) const;
  double body_value(const Vec3& offset) const;
  double body_under_face_value(const Vec3& world_mm) const;
  double processes_value(const Vec3& in_scapula) const;
  static double anatomical_shaft_mm(const Vec3& from_head_in_scapula);
  Vec3 in_scapula(const Vec3& offset) const;
  double osteophytes_value(const Vec3& world_mm) const;

  /// Of a face of that version and the inclination that was asked for.
  struct FaceFrame {
    Vec3 normal, superior, anterior;
  };
  FaceFrame frame_of(double version_rad) const;
  void place_head();
  void carve_neoglenoid();
  /// World point of the articular surface so far superior and anterior, along the face, of its worn centre.
  Vec3 on_face(double superior_mm, double anterior_mm) const;
  /// How far the face reaches to its rim, mm: up (+1) or down (-1) from its middle, and to the front (+1) or
  /// the back (-1) at its widest level.
  double reach_superior_mm(double direction) const;
  double reach_anterior_mm(double direction) const;
  case_::Landmarks landmarks() const;
  void add_biconcavity(GroundTruth& truth) const;

  PhantomParams params_;
  Vec3 centre_, lateral_, superior_, posterior_;  // scapular frame
  double version_rad_ = 0;                        // of the face as it is
  FaceFrame vault_, face_;  // of the native face, whose the vault is; of the face as it is
  Vec3 medial_in_vault_;    // -lateral_ in (superior, anterior, normal) of vault_
  Vec3 worn_centre_;        // of the face; centre_ where it is not worn
  double face_radius_mm_ = 0;
  Vec3 sphere_centre_, head_centre_;
  std::optional<Neoglenoid> neoglenoid_;
  std::optional<AnatomicalScapula> anatomical_;  // with a believable body, acromion, coracoid and humerus
};

}  // namespace ream::ct
