#pragma once
#include <vector>

#include "score/bone_surface.hpp"
#include "score/cut_axis.hpp"
#include "score/cutting_surface.hpp"
#include "score/native_glenoid.hpp"

namespace ream::score {

/// What is left of a glenoid, along the rays of its NativeGlenoid.
struct AchievedFace {
  /// Depth of what the ray meets first now, mm; no_surface_mm where it meets nothing, or where all bone that
  /// it went through before is gone and what it meets lies behind that.
  std::vector<double> surface_mm;
  /// Depth of bone and cartilage removed along the ray, mm; 0 off the face.
  std::vector<double> removed_mm;
  double voxel_mm = 0.0;  ///< of the bone that it was measured on; 0: of formulas
};

/// One ray of it.
struct AchievedRay {
  double surface_mm = no_surface_mm, removed_mm = 0.0;
};
AchievedRay achieved_ray(const NativeGlenoid& native, const SurfaceFinder& left, size_t ray);

/// `left`: what remains of the bone, with the bone at rest.
AchievedFace achieved_face(const NativeGlenoid& native, const CoverageView& left);

/// An implant as a surgeon would seat it: its back is a sphere of the planned implant's radius, or without
/// one the reamer's own shape; half a millimetre less wide all around than the reamer, about the achieved
/// axis; pressed along that axis onto what is left of the face until 1 % of the area above the face would
/// have to sink in (bone gives way a little). It is trimmed to the native face, as components are chosen not
/// to overhang, and the pilot hole is left out.
class Component {
 public:
  static constexpr double clearance_mm = 0.5;    ///< to the wall around what was reamed
  static constexpr double contact_mm = 0.5;      ///< a gap up to this supports
  static constexpr double sinking_share = 0.01;  ///< of the area

  /// `line`: the achieved axis in the frame of the lattice (across, up, depth).
  Component(const NativeGlenoid& native, const AchievedFace& face, const CutLine& line);

  /// False when there is no bone to seat it on.
  bool seated() const { return seated_; }
  /// Share of its back with a gap of at most contact_mm, 0 to 1.
  double supported_share() const { return supported_share_; }
  /// Rays of the native face within its outline.
  const std::vector<size_t>& footprint() const { return footprint_; }
  /// Middle of its back, and the axis into the bone; frame of the lattice.
  Vec3 apex_mm() const;
  const Vec3& axis() const { return line_.direction; }
  const CuttingMeridian& back() const { return back_; }
  /// How far it reaches from its axis.
  double outline_radius_mm() const { return outline_mm_; }

 private:
  struct Spot;  ///< of its back over a ray

  std::vector<Spot> spots_over(const NativeGlenoid& native, const AchievedFace& face) const;
  void seat(std::vector<Spot>& spots);

  CutLine line_;
  double outline_mm_;  ///< radius
  CuttingMeridian back_;
  std::vector<size_t> footprint_;
  bool seated_ = false;
  double along_mm_ = 0.0;  ///< of its apex from line_.apex_mm
  double supported_share_ = 0.0;
};

}  // namespace ream::score
