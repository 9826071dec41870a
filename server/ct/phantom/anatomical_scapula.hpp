#pragma once
#include <vector>

#include "ct/phantom/implicit_solids.hpp"
#include "geometry/vec.hpp"

namespace ream::ct {

/// How one scapula differs from the mean one; all zero (and scale 1) is the mean. The mean and the spread
/// that shoulders are drawn with (individual.hpp) follow 97 cadavers (Siriraj Med J 56, 2004), 67 CTs of
/// whole scapulae (J Mil Pharmaco-Med 2021, glenopolar angle) and 3D critical shoulder angles (Mah 2021).
struct AnatomicalSizes {
  double scale = 1.0;                 ///< of all but the glenoid's face and vault
  double acromion_lateral_mm = 0.0;   ///< how much farther its lateral edge reaches
  double acromion_superior_mm = 0.0;  ///< how much higher it lies
  double coracoid_lateral_mm = 0.0, coracoid_anterior_mm = 0.0;  ///< of its tip
  double body_bow_mm = 6.0;  ///< how far the body's middle lies behind the plane of its borders
};

/// A bent plate with an elliptic section: capsules along a smooth curve, flattened along one direction.
class FlatSweep {
 public:
  struct Knot {
    Vec3 at;                 ///< mm, on the plate's middle line
    double half_breadth_mm;  ///< half of its section across
  };
  /// `flat` is the direction (any length) in which the section is `flatness` times thinner than across.
  /// Values over `far_mm` need only be over it.
  FlatSweep(const std::vector<Knot>& knots, const Vec3& flat, double flatness, double far_mm);

  /// Negative within; about mm near the surface, too small by up to `flatness` along its edges.
  double value(const Vec3& p) const;

 private:
  Vec3 stretched(const Vec3& p) const { return p + (flatness_ - 1.0) * p.dot(flat_) * flat_; }

  /// A part of the stretched curve, and the sphere that holds it.
  struct Segment {
    Capsule capsule;
    Vec3 middle;
    double reach;
  };

  Vec3 flat_;
  double flatness_, far_mm_;
  std::vector<Segment> segments_;
  Vec3 centre_ = Vec3::Zero();  // of a sphere that holds all
  double radius_mm_ = 0.0;
};

/// Body, spine, acromion and coracoid of a believable scapula in PhantomShape's scapular frame, mm. Near the
/// joint (within about 44 mm medial of the face, 24 mm above and 26 mm behind it) spine and coracoid are
/// those of the simple phantom to the bit, so that both have the same glenoid, vault and neck.
class AnatomicalScapula {
 public:
  explicit AnatomicalScapula(const AnatomicalSizes& sizes);

  /// The body, medial of the neck: a bowed plate, thin in its middle, thick along the lateral border.
  double body_value(const Vec3& p) const;
  /// How much of the body at a depth under the face, mm, is that plate: 0 in the neck, 1 beyond it.
  static double body_share(double depth_mm);
  /// Spine, acromion and coracoid; over `far_mm` it may jump.
  double processes_value(const Vec3& p) const;
  static constexpr double far_mm = 12.0;

 private:
  AnatomicalSizes sizes_;
  FlatSweep crest_, acromion_, coracoid_;
};

// What both phantoms share, scapular frame, mm.
inline const Vec3 spine_root(-105.0, 0.0, 0.0), inferior_angle(-88.0, -108.0, 0.0);
inline const Vec3 acromion_corner(8.0, 26.0, 34.0), coracoid_bend(-10.0, 32.0, -14.0),
    coracoid_tip(10.0, 27.0, -34.0);
inline constexpr double joint_rounding_mm = 3.0;  // where two parts meet
inline constexpr double coracoid_radius_mm = 6.0, coracoid_tip_radius_mm = 4.5;

/// Spine and the bases of acromion and coracoid, which both phantoms share: what lies beyond is theirs.
struct ProcessBases {
  double spine, acromion, coracoid;
};
ProcessBases process_bases(const Vec3& in_scapula);

}  // namespace ream::ct
