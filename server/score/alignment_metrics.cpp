#include "score/metric_groups.hpp"

namespace ream::score {
namespace {

constexpr std::string_view malposition =
    "Throckmorton 2015, Hagan 2023: malposition is over 10 degrees or 4 mm; the limits of 5 degrees and 2 mm "
    "are ours";
constexpr std::string_view scapular_plane =
    "3D against the plane of trigonum, inferior angle and glenoid centre (science 2.1)";
constexpr std::string_view angle_checked = "within 0.2 degrees of the truth in 100 seeded reamings";
constexpr std::string_view entry_checked = "within 0.1 mm of the truth in 100 seeded reamings";
constexpr std::string_view rim_depends =
    "depends on the shape of the face: a sphere's rim lies across the line of both centres, not across the "
    "tool";
constexpr std::string_view of_the_plan = "as exact as the landmarks that were placed";

constexpr Metric metrics[] = {
    {"version_planned_deg", "Version planned", "deg",
     "Version of a face across the planned axis, retroversion negative.", scapular_plane, Evidence::judgement,
     of_the_plan, only_reported},
    {"version_achieved_deg", "Version achieved", "deg",
     "Version of a face across the achieved axis: the tool's axis, weighted by removed volume over the last "
     "0.5 mm of advance; retroversion negative.",
     scapular_plane, Evidence::judgement, angle_checked, only_reported},
    {"version_error_deg", "Version error", "deg", "Absolute difference of version achieved and planned.",
     malposition, Evidence::published, angle_checked, at_most(5.0, 10.0)},
    {"retroversion_achieved_deg", "Retroversion remaining", "deg",
     "Retroversion of the achieved face, positive; version achieved with the other sign.",
     "PMC4857532: within 7 degrees of neutral is achieved; Ho 2013: osteolysis from 15 degrees on",
     Evidence::published, "the lower limit is published, the upper common knowledge", at_most(7.0, 15.0)},
    {"inclination_planned_deg", "Inclination planned", "deg",
     "Inclination of a face across the planned axis, superior positive.", scapular_plane, Evidence::judgement,
     of_the_plan, only_reported},
    {"inclination_achieved_deg", "Inclination achieved", "deg",
     "Inclination of a face across the achieved axis, superior positive.", scapular_plane,
     Evidence::judgement, angle_checked, only_reported},
    {"inclination_error_deg", "Inclination error", "deg",
     "Absolute difference of inclination achieved and planned.", malposition, Evidence::published,
     angle_checked, at_most(5.0, 10.0)},
    {"version_rim_deg", "Version of the rim", "deg",
     "Version of the plane that fits the rim of what was reamed, by 360 points at equal angles about its "
     "middle.",
     scapular_plane, Evidence::judgement, rim_depends, only_reported},
    {"inclination_rim_deg", "Inclination of the rim", "deg",
     "Inclination of the plane that fits the rim of what was reamed.", scapular_plane, Evidence::judgement,
     rim_depends, only_reported},
    {"axis_error_deg", "Axis error", "deg", "Angle between achieved and planned axis.",
     "Karelse 2014, Axford 2019 (surgeons with feedback come within 1 degree); limits as for version",
     Evidence::published, angle_checked, at_most(5.0, 10.0)},
    {"entry_error_mm", "Entry error", "mm",
     "Distance of the places where achieved and planned axis meet the untouched surface.", malposition,
     Evidence::published, entry_checked, at_most(2.0, 4.0)},
    {"centre_error_mm", "Centre error", "mm",
     "Distance of the tool's apex at its deepest from where the plan has it: on the planned axis, the "
     "planned "
     "depth past the reamer's first contact.",
     "Karelse 2014: centre and direction differ between surgeons; limits as for entry", Evidence::published,
     "holds the error of depth, too", at_most(2.0, 4.0)},
    {"depth_error_mm", "Depth error", "mm", "Absolute difference of reaming depth and planned depth.",
     "engineering judgement", Evidence::judgement, "as exact as first contact", only_reported},
    {"pilot_entry_distance_mm", "Distance to pilot entry", "mm",
     "Distance of the places where the achieved axis and that of the pilot hole meet the untouched surface. "
     "The hole is the planned one, which is in the bone before the session.",
     malposition, Evidence::published, entry_checked, at_most(2.0, 4.0)},
    {"pilot_angle_deg", "Angle to pilot hole", "deg",
     "Angle between the achieved axis and that of the pilot hole.", malposition, Evidence::published,
     angle_checked, at_most(5.0, 10.0)},
    {"plan_correction_deg", "Correction planned", "deg",
     "Angle between the native face and one across the planned axis: what reaming alone is asked to correct.",
     "Clavert 2007: from 15 degrees on 5 of 5 pegged components perforate; eccentric reaming is used for 5 "
     "to "
     "10 degrees",
     Evidence::published, of_the_plan, at_most(10.0, 15.0)},
};

}  // namespace

std::span<const Metric> alignment_metrics() { return metrics; }

}  // namespace ream::score
