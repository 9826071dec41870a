#pragma once
#include <filesystem>
#include <memory>
#include <vector>

#include "case/case.hpp"
#include "support/analytic_glenoid.hpp"

namespace ream::test {

/// A reamer as a convex body in its own frame: half an ellipsoid (a sphere where both semi-axes are equal)
/// out to a radius, flat within that of its nipple, and half a millimetre of body behind its rim.
struct ReamerShape {
  double across_mm = 30.0, along_mm = 30.0, outer_mm = 10.0, nipple_mm = 0.0;

  double component_mm() const { return outer_mm - 0.5; }  ///< radius of what is seated in what it reamed
  double behind_mm(double radius_mm) const;
  std::string words() const;  ///< as make_tool takes them, with an 8 mm nipple where there is one
};

/// A glenoid, a plan, and with what it is to be reamed.
struct PlannedReaming {
  AnalyticGlenoid glenoid;
  case_::Plan plan;
  ReamerShape reamer;
  double pilot_margin_mm = 0.4;  ///< left out of the face around the pilot hole: a voxel
};

/// A component as it was seated: the middle of its back, and its axis into the bone. World frame.
struct SeatedTruth {
  Vec3 apex_mm = Vec3::Zero(), axis = Vec3::UnitZ();
};

/// A place of the reamed face that counts, on a lattice along the plan: square, a quarter of a millimetre
/// apart, through the entry, one of its sides along what of the world's z lies across the plan.
struct ReamedPlace {
  int column = 0, row = 0;
  Vec3 world_mm = Vec3::Zero();
};
inline constexpr double reamed_place_spacing_mm = 0.25;

/// What must come out, by the glenoid's formulas and the poses of trace.csv alone: the union of the reamer at
/// those poses, taken from the glenoid, integrated numerically in double precision.
struct ReamingTruth {
  double version_deg = 0.0, inclination_deg = 0.0;
  double axis_error_deg = 0.0, entry_error_mm = 0.0;
  double volume_mm3 = 0.0;
  double depth_max_mm = 0.0, depth_mean_mm = 0.0, footprint_mm2 = 0.0;
  double seating_percent = 0.0, plate_percent = 0.0;
  double rim_version_deg = 0.0, rim_inclination_deg = 0.0;
  double planned_mm3 = 0.0;  ///< of the face, if the plan is carried out
  double overreamed_mm3 = 0.0, underreamed_mm3 = 0.0, overlap_percent = 0.0;  ///< against that
  double seating_planned_percent = 0.0, plate_planned_percent = 0.0;          ///< of that
  SeatedTruth seated, seated_as_planned;
  std::vector<ReamedPlace> reamed;
};

/// How deep the bone is gone along the plan while it is being reamed, by the glenoid's formulas and the
/// reamer's poses alone, on lines a quarter of a millimetre apart.
class DepthTruth {
 public:
  explicit DepthTruth(const PlannedReaming& planned);
  ~DepthTruth();

  /// The reamer stood there and cut.
  void cut_at(const Pose& world_from_tool);
  /// Whether the reamer reaches into the untouched glenoid there.
  bool touches(const Pose& world_from_tool) const;
  double depth_mm() const;

 private:
  struct Lines;
  std::unique_ptr<Lines> lines_;
};

ReamingTruth reaming_truth(const PlannedReaming& planned, const std::filesystem::path& trace_csv);

}  // namespace ream::test
