#include "score/planned_face.hpp"

#include <algorithm>
#include <cmath>

#include "score/alignment.hpp"
#include "score/joint_line.hpp"

namespace ream::score {
namespace {

/// Depth of the planned reamer's front on a ray, mm; nothing beyond its rim.
double front_mm(const NativeGlenoid& native, size_t ray, double apex_mm) {
  const double radius_mm = std::hypot(native.rays().x_mm(ray), native.rays().y_mm(ray));
  return radius_mm > native.reamer().outer_mm() ? -no_surface_mm
                                                : apex_mm - native.reamer().behind_mm(radius_mm);
}

/// Thickness of the plate on a ray, mm: untouched, and what is left of it.
struct PlateOnRay {
  double whole_mm, left_mm;
};

PlateOnRay plate_on(const NativeGlenoid& native, const std::vector<double>& removed_mm, size_t ray) {
  const double top = native.subchondral_mm()[ray];
  const double whole = std::min(native.plate().thickness_mm[ray], native.exit_mm()[ray] - top);
  return {whole, top + whole - std::max(top, native.surface_mm()[ray] + removed_mm[ray])};
}

/// Share of the plate's bone under a footprint that is left; empty without any.
std::optional<double> plate_left_percent(const NativeGlenoid& native, const std::vector<double>& removed_mm,
                                         const std::vector<size_t>& footprint) {
  double whole_mm = 0.0, left_mm = 0.0;
  for (const size_t ray : footprint) {
    const PlateOnRay plate = plate_on(native, removed_mm, ray);
    whole_mm += plate.whole_mm;
    left_mm += std::max(0.0, plate.left_mm);
  }
  return whole_mm > 0.0 ? std::optional(100.0 * left_mm / whole_mm) : std::nullopt;
}

AchievedFace face_left_by(const NativeGlenoid& native, double apex_mm) {
  AchievedFace face;
  for (size_t ray = 0; ray < native.rays().size(); ++ray) {
    const double surface = native.surface_mm()[ray], gone = native.exit_mm()[ray];
    const double left = std::max(surface, front_mm(native, ray, apex_mm));
    const bool on_face = native.face()[ray] != 0;
    face.removed_mm.push_back(on_face ? std::min(left, gone) - surface : 0.0);
    face.surface_mm.push_back(!on_face ? surface : left < gone ? left : no_surface_mm);
  }
  return face;
}

}  // namespace

std::optional<PlannedCut> planned_cut(const NativeGlenoid& native) {
  const auto& plan = native.task().plan;
  const std::optional<double> contact = plan ? first_contact_mm(native) : std::nullopt;
  if (!contact) return std::nullopt;
  PlannedCut cut;
  cut.line.apex_mm.z() = cut.line.deepest_mm = *contact + plan->depth_mm;
  cut.face = face_left_by(native, cut.line.deepest_mm);
  return cut;
}

PlannedFace planned_face(const NativeGlenoid& native) {
  PlannedFace planned;
  std::optional<PlannedCut> cut = planned_cut(native);
  if (!cut) return planned;
  AchievedFace& face = cut->face;
  const CutLine& line = cut->line;
  const Component component(native, face, line);
  if (component.seated()) planned.seating_percent = 100.0 * component.supported_share();
  planned.plate_percent = plate_preserved_percent(native, face.removed_mm, component.footprint());
  planned.plate_left_percent = plate_left_percent(native, face.removed_mm, component.footprint());
  planned.joint_line_mm = joint_line_mm(native, component);
  planned.removed_mm = std::move(face.removed_mm);
  return planned;
}

std::optional<double> plate_preserved_percent(const NativeGlenoid& native,
                                              const std::vector<double>& removed_mm,
                                              const std::vector<size_t>& footprint) {
  if (footprint.empty()) return std::nullopt;
  size_t preserved = 0;
  for (const size_t ray : footprint) {
    const PlateOnRay plate = plate_on(native, removed_mm, ray);
    preserved += plate.left_mm >= 0.5 * plate.whole_mm;
  }
  return 100.0 * static_cast<double>(preserved) / static_cast<double>(footprint.size());
}

void measure_planned_face(const PlannedFace& planned, MetricResults& results) {
  results.set_or_missing("seating_planned_percent", planned.seating_percent, not_planned);
  results.set_or_missing("plate_planned_percent", planned.plate_percent, not_planned);
  results.set_or_missing("joint_line_planned_mm", planned.joint_line_mm, not_planned);
}

void measure_against_plan(const NativeGlenoid& native, const PlannedFace& planned, const AchievedFace& face,
                          const Component& component, MetricResults& results) {
  if (!planned.known()) {
    for (const char* key : {"overreamed_volume_mm3", "underreamed_volume_mm3", "plan_overlap_percent",
                            "seating_short_percent", "plate_lost_percent"})
      results.set_missing(key, not_planned);
    return;
  }
  double both_mm = 0.0, over_mm = 0.0, under_mm = 0.0;
  for (size_t ray = 0; ray < native.rays().size(); ++ray) {
    const double achieved = face.removed_mm[ray], wanted = planned.removed_mm[ray];
    both_mm += std::min(achieved, wanted);
    over_mm += std::max(0.0, achieved - wanted);
    under_mm += std::max(0.0, wanted - achieved);
  }
  const double area_mm2 = native.rays().cell_area_mm2(), all_mm = 2.0 * both_mm + over_mm + under_mm;
  results.set("overreamed_volume_mm3", over_mm * area_mm2);
  results.set("underreamed_volume_mm3", under_mm * area_mm2);
  results.set_or_missing("plan_overlap_percent",
                         all_mm > 0.0 ? std::optional(200.0 * both_mm / all_mm) : std::nullopt,
                         "neither plan nor session removes anything of the face");
  const auto short_of = [&](const char* key, const std::optional<double>& achieved,
                            const std::optional<double>& wanted) {
    std::optional<double> missing;
    if (achieved && wanted) missing = std::max(0.0, *wanted - *achieved);
    results.set_or_missing(key, missing, achieved ? not_planned : "the achieved one cannot be measured");
  };
  short_of("seating_short_percent", results.value("seating_percent"), planned.seating_percent);
  short_of("plate_lost_percent", plate_left_percent(native, face.removed_mm, component.footprint()),
           planned.plate_left_percent);
}

}  // namespace ream::score
