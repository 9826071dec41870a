#include "score/joint_line.hpp"

#include "score/alignment.hpp"
#include "score/component_library.hpp"

namespace ream::score {
namespace {

/// Middle of the articular surface from where the planned axis meets the untouched face; frame of the
/// lattice.
std::optional<Vec3> articular_middle_from_native(const NativeGlenoid& native, const Component& component) {
  const double native_mm = native.rays().between(native.surface_mm(), 0.0, 0.0);
  if (!component.seated() || native_mm == no_surface_mm) return std::nullopt;
  const double thickness_mm = component_of(native.task().plan).thickness_mm;
  return component.apex_mm() - thickness_mm * component.axis() - Vec3(0.0, 0.0, native_mm);
}

/// Along the planned axis, which points into the bone.
std::optional<double> lateral_of(const std::optional<Vec3>& middle) {
  return middle ? std::optional(-middle->z()) : std::nullopt;
}

}  // namespace

std::optional<double> joint_line_mm(const NativeGlenoid& native, const Component& component) {
  return lateral_of(articular_middle_from_native(native, component));
}

void measure_joint_line(const NativeGlenoid& native, const PlannedFace& planned, const Component& component,
                        MetricResults& results) {
  const char* not_placed = component.seated() ? "the planned axis meets no untouched bone"
                                              : "there is no bone left to seat a component on";
  const auto middle = articular_middle_from_native(native, component);
  const auto achieved = lateral_of(middle);
  results.set_or_missing("joint_line_mm", achieved, not_placed);
  std::optional<double> off_plan;
  if (achieved && planned.joint_line_mm) off_plan = *achieved - *planned.joint_line_mm;
  results.set_or_missing("joint_line_offset_mm", off_plan, achieved ? not_planned : not_placed);
  const auto frame = scapular_frame_of(native.task());
  std::optional<double> lateral;
  if (frame && middle) lateral = native.rays().world_direction(*middle).dot(frame->lateral);
  results.set_or_missing("lateralization_mm", lateral, frame ? not_placed : no_scapular_frame);
}

}  // namespace ream::score
