#include "score/metric_catalogue.hpp"

#include <algorithm>

namespace ream::score {
namespace {

using enum Evidence;
using enum MetricGroup;
using enum Basis;
using enum Style;

constexpr Range any{}, positive{.min = 0.0, .min_excluded = true}, not_negative{.min = 0.0};
constexpr Range percent_range{0.0, 100.0}, any_angle{-180.0, 180.0}, angle_size{0.0, 180.0};

constexpr std::optional<Better> no_aim;
constexpr Band only_reported{};
constexpr Band at_most(double pass, double warn) { return {Better::less, pass, warn, 0.0}; }
constexpr Band at_least(double pass, double warn) { return {Better::more, pass, warn, 0.0}; }
constexpr Band between(double low, double high) { return {Better::between, high, high, low}; }

constexpr std::string_view malposition =
    "Throckmorton 2015, Hagan 2023: malposition is over 10 degrees or 4 mm; the limits of 5 degrees and 2 mm "
    "are ours";
constexpr std::string_view scapular_plane =
    "3D, against the plane of trigonum, inferior angle and glenoid centre; Friedman's version is its like in "
    "one axial slice, Churchill's inclination has the same axis, Maurer's beta another";
constexpr std::string_view angle_checked =
    "within 0.2 degrees of the truth in 100 seeded reamings of formula bones; scan and landmarks come on top";
constexpr std::string_view entry_checked =
    "within 0.1 mm of the truth in 100 seeded reamings of formula bones";
constexpr std::string_view rim_depends =
    "depends on the shape of the face: a sphere's rim lies across the line of both centres, not across the "
    "tool; up to a degree off where the reamer walked and left a ledge";
constexpr std::string_view of_the_plan = "as exact as the landmarks that were placed";
constexpr std::string_view checked_sum =
    "an exact sum over ticks; within 0.5 % of the truth in seeded reamings of formula bones";
constexpr std::string_view half_voxel =
    "within half a voxel of the truth in 100 seeded reamings of formula bones";
constexpr std::string_view half_voxel_volume =
    "exact to half a voxel's thickness over the face; the plan is that of the reamer that was used";
constexpr std::string_view limits_ours = "limits are engineering judgement";
constexpr std::string_view clavert =
    "Clavert 2007 (perforation); the limit of 2 mm and the sizes of peg and keel are engineering judgement";
constexpr std::string_view no_limits = "reported without limits";
// A distance of exactly nothing is a breach.
constexpr double barely_mm = 1e-6;
constexpr std::string_view exact_sum = "an exact sum over ticks";
constexpr std::string_view thesis =
    "52 N: Faieghi 2018; factors 2/3 to 4/3, 1.5 and 2 are engineering judgement";
constexpr std::string_view time_and_motion = "OSATS, time and motion";
constexpr std::string_view balasubramanian =
    "Balasubramanian 2015, of tip speed at 100 Hz; tested by its authors for discrete movements only";
constexpr std::string_view nigam =
    "Nigam 2022: experts cut force before the far layer; overshoot did not separate groups, time did (4.0 "
    "and 10.0 s)";
constexpr std::string_view eriksson =
    "Eriksson and Albrektsson: 47 degrees for a minute and 56 at once; the lower limits are ours";
constexpr std::string_view heat_model =
    "of a 1-D model; what of the spindle's power goes into bone, 0.3 to 0.7, is known to 40 %";
constexpr std::string_view economy =
    "time and motion: economy of movement, the ideal path length over the actual one; what is ideal is ours";
constexpr std::string_view economy_checked =
    "exact to rounding against a second computation on 50 seeded paths; to be compared with experts on the "
    "same simulator";
constexpr std::string_view rate_checked =
    "within 0.1 % of the formula for sines and of a second computation on 50 seeded thrusts; to be compared "
    "with experts on the same simulator";
constexpr std::string_view joint_line_ours =
    "engineering judgement: what arthroplasty calls shift of the joint line, along two axes that are named";
constexpr std::string_view wall_ours =
    "Clavert 2007 (perforation, fracture of the rim); the measure and its 3 mm and 2.5 mm are ours";
constexpr std::string_view wall_checked =
    "within half a voxel of the truth in 50 seeded reamings of formula bones; half a voxel at least, and as "
    "exact as the vault's wall in the scan";
constexpr std::string_view own_component =
    "the component is the one of the library that the plan's implant_size names, else its \"pegged medium\"; "
    "their sizes are ours";
constexpr std::string_view joint_line_checked =
    "within half a voxel of the truth in 50 seeded reamings of formula bones; a component is taken to be 4 "
    "mm thick";
constexpr std::string_view compare = "to be compared with experts on the same simulator";

constexpr Metric catalogue[] = {
    {"version_planned_deg", "Version planned", "deg",
     "Version of a face across the planned axis, retroversion negative: how far it is turned about the "
     "scapula's upright, out of the plane across the line from trigonum to glenoid centre.",
     scapular_plane, judgement, of_the_plan, alignment, plan, any_angle, only_reported, no_aim, version},
    {"version_achieved_deg", "Version achieved", "deg",
     "Version of a face across the achieved axis: the tool's axis, weighted by removed volume over the last "
     "0.5 mm of advance; retroversion negative.",
     scapular_plane, judgement, angle_checked, alignment, achieved_axis, any_angle, only_reported, no_aim,
     version, "version_planned_deg"},
    {"version_error_deg", "Version error", "deg", "Absolute difference of version achieved and planned.",
     malposition, published, angle_checked, alignment, achieved_axis, angle_size, at_most(5.0, 10.0)},
    {"retroversion_achieved_deg", "Retroversion remaining", "deg",
     "Retroversion of the achieved face, positive; version achieved with the other sign.",
     "PMC4857532: within 7 degrees of neutral is achieved; Ho 2013: osteolysis from 15 degrees on", published,
     "the lower limit is published, the upper common knowledge", alignment, achieved_axis, any_angle,
     at_most(7.0, 15.0)},
    {"version_excess_deg", "Version beyond neutral", "deg",
     "How much farther the achieved face leans from neutral version than 7 degrees, or than the plan where "
     "that leans farther.",
     "PMC4857532: within 7 degrees of neutral is achieved; Ho 2013: osteolysis from 15 degrees on", published,
     angle_checked, alignment, achieved_axis, angle_size, at_most(1.0, 8.0)},
    {"inclination_planned_deg", "Inclination planned", "deg",
     "Inclination of a face across the planned axis, superior positive: how far it is tilted in the scapular "
     "plane, against a line across that from trigonum to glenoid centre (Churchill's axis). It is not "
     "Maurer's beta, which is against the floor of the supraspinatus fossa.",
     scapular_plane, judgement, of_the_plan, alignment, plan, any_angle, only_reported, no_aim, inclination},
    {"inclination_achieved_deg", "Inclination achieved", "deg",
     "Inclination of a face across the achieved axis, superior positive.", scapular_plane, judgement,
     angle_checked, alignment, achieved_axis, any_angle, only_reported, no_aim, inclination,
     "inclination_planned_deg"},
    {"inclination_error_deg", "Inclination error", "deg",
     "Absolute difference of inclination achieved and planned.", malposition, published, angle_checked,
     alignment, achieved_axis, angle_size, at_most(5.0, 10.0)},
    {"version_rim_deg", "Version of the rim", "deg",
     "Version of the plane that fits the rim of what was reamed, by 360 points at equal angles about its "
     "middle; ledges and walls count little (Huber, 0.25 mm).",
     scapular_plane, judgement, rim_depends, alignment, reamed_bone, any_angle, only_reported, no_aim,
     version},
    {"inclination_rim_deg", "Inclination of the rim", "deg",
     "Inclination of the plane that fits the rim of what was reamed.", scapular_plane, judgement, rim_depends,
     alignment, reamed_bone, any_angle, only_reported, no_aim, inclination},
    {"axis_error_deg", "Axis error", "deg", "Angle between achieved and planned axis.",
     "Karelse 2014, Axford 2019 (surgeons with feedback come within 1 degree); limits as for version",
     published, angle_checked, alignment, achieved_axis, angle_size, at_most(5.0, 10.0)},
    {"entry_error_mm", "Entry error", "mm",
     "Distance of the places where achieved and planned axis meet the untouched surface.", malposition,
     published, entry_checked, alignment, achieved_axis, not_negative, at_most(2.0, 4.0)},
    {"centre_error_mm", "Centre error", "mm",
     "Distance of the tool's apex at its deepest from where the plan has it: on the planned axis, the "
     "planned depth past the reamer's first contact.",
     "Karelse 2014: centre and direction differ between surgeons; limits as for entry", published,
     "holds the error of depth, too", alignment, achieved_axis, not_negative, at_most(2.0, 4.0)},
    {"depth_error_mm", "Depth error", "mm", "Absolute difference of reaming depth and planned depth.",
     "engineering judgement: half a millimetre and a millimetre, of a plate of 1.9 (Frich 1998)", judgement,
     "as exact as first contact", alignment, achieved_axis, not_negative, at_most(0.5, 1.0)},
    {"pilot_entry_distance_mm", "Distance to pilot entry", "mm",
     "Distance of the places where the achieved axis and that of the pilot hole meet the untouched surface. "
     "The hole is the planned one, which is in the bone before the session.",
     malposition, published, entry_checked, alignment, achieved_axis, not_negative, at_most(2.0, 4.0)},
    {"pilot_angle_deg", "Angle to pilot hole", "deg",
     "Angle between the achieved axis and that of the pilot hole.", malposition, published, angle_checked,
     alignment, achieved_axis, angle_size, at_most(5.0, 10.0)},
    {"plan_correction_deg", "Correction planned", "deg",
     "Angle between the native face and one across the planned axis: what reaming alone is asked to correct.",
     "Clavert 2007: from 15 degrees on 5 of 5 pegged components perforate; eccentric reaming is used for 5 "
     "to 10 degrees",
     published, of_the_plan, alignment, plan, angle_size, at_most(10.0, 15.0)},
    {"removed_volume_mm3", "Volume removed", "mm3", "Bone and cartilage removed, the pilot hole left out.",
     no_limits, tested, checked_sum, bone, ticks, not_negative, only_reported},
    {"removed_volume_cortical_mm3", "Cortical volume removed", "mm3",
     "Of it, voxels at least as dense as the threshold of cortical bone.", no_limits, tested, checked_sum,
     bone, ticks, not_negative, only_reported},
    {"removed_volume_cancellous_mm3", "Cancellous volume removed", "mm3", "Of it, bone below that threshold.",
     no_limits, tested, checked_sum, bone, ticks, not_negative, only_reported},
    {"removed_volume_cartilage_mm3", "Cartilage volume removed", "mm3", "Of it, cartilage.", no_limits,
     tested, checked_sum, bone, ticks, not_negative, only_reported},
    {"reaming_depth_mm", "Reaming depth", "mm",
     "Greatest depth of removed bone and cartilage along the planned axis over the face, where bone is left "
     "under it and without the pilot hole. Zero is where the reamer on the planned axis touches first.",
     "Frich 1998: plate of 1.9 mm; limits stand with medialization", judgement, half_voxel, bone, reamed_bone,
     not_negative, only_reported, no_aim, number, "depth_planned_mm"},
    {"depth_planned_mm", "Depth planned", "mm", "Reaming depth if the plan is carried out exactly.",
     no_limits, judgement, "as the plan has it", bone, plan, not_negative, only_reported},
    {"depth_mean_mm", "Mean depth", "mm",
     "Mean depth of removed bone and cartilage along the planned axis, over where at least 0.05 mm is gone.",
     no_limits, judgement, half_voxel, bone, reamed_bone, not_negative, only_reported},
    {"medialization_mm", "Medialization", "mm",
     "Greatest depth along the planned axis past the native subchondral surface, which is the bone under any "
     "cartilage.",
     "Frich 1998: plate of 1.9 mm (1.2 to 2.9)", judgement, limits_ours, bone, reamed_bone, not_negative,
     at_most(2.0, 3.0)},
    {"joint_line_planned_mm", "Joint line planned", "mm", "Joint line if the plan is carried out exactly.",
     joint_line_ours, judgement, "by the same measure", bone, untouched_bone, any, only_reported},
    {"joint_line_mm", "Joint line", "mm",
     "How far the middle of the component's articular surface lies lateral of the native joint line, medial "
     "negative: along the planned axis, from where that meets the untouched face. Where the component fits a "
     "face reamed along the plan this is its thickness less medialization and cartilage.",
     joint_line_ours, judgement, joint_line_checked, bone, reamed_bone, any, only_reported, no_aim, number,
     "joint_line_planned_mm"},
    {"joint_line_offset_mm", "Joint line against the plan", "mm",
     "Joint line less joint line planned: lateral positive.", joint_line_ours, judgement, joint_line_checked,
     bone, reamed_bone, any, only_reported},
    {"lateralization_mm", "Lateralization", "mm",
     "The same place of the articular surface, from the same place of the untouched face, along the "
     "scapula's "
     "lateral axis from the trigonum to the glenoid's centre; medial negative.",
     joint_line_ours, judgement, joint_line_checked, bone, reamed_bone, any, only_reported},
    {"plan_overlap_percent", "Overlap with the plan", "%",
     "Dice's coefficient of what was removed of the face and what the plan removes: twice what both have, "
     "over the sum of both; along rays that are parallel to the planned axis.",
     "Dice 1945; limits are ours", judgement, half_voxel_volume, bone, reamed_bone, percent_range,
     at_least(85.0, 50.0)},
    {"overreamed_volume_mm3", "Removed beyond the plan", "mm3",
     "Of the face, what was removed and the plan leaves.", no_limits, judgement, half_voxel_volume, bone,
     reamed_bone, not_negative, only_reported, Better::less},
    {"underreamed_volume_mm3", "Left of the plan", "mm3", "Of the face, what the plan removes and was left.",
     no_limits, judgement, half_voxel_volume, bone, reamed_bone, not_negative, only_reported, Better::less},
    {"footprint_area_mm2", "Footprint", "mm2",
     "Area across the planned axis in which at least 0.05 mm of the face is gone.", no_limits, judgement,
     "counted on a lattice of 0.25 mm", bone, reamed_bone, not_negative, only_reported},
    {"seating_percent", "Seating", "%",
     "Share of the implant's back that lies within 0.5 mm of the reamed face. The back is a sphere of the "
     "implant's radius (without one, the reamer's own shape), half a millimetre narrower all around than the "
     "reamer, trimmed to the native face and without the pilot hole; pressed along the achieved axis until 1 "
     "% of it would have to sink in.",
     "Lazarus 2002 (percentage supported by bone); 0.5 mm, 80 % and 90 % are ours", judgement,
     "within 1 point of the truth in 100 seeded reamings of formula bones; limits are engineering judgement",
     bone, reamed_bone, percent_range, at_least(90.0, 80.0), no_aim, number, "seating_planned_percent"},
    {"seating_planned_percent", "Seating planned", "%", "Seating if the plan is carried out exactly.",
     no_limits, judgement, "by the same measure", bone, untouched_bone, percent_range, only_reported, no_aim,
     number},
    {"seating_short_percent", "Seating short of the plan", "%",
     "Seating planned less seating achieved; 0 where that is more.", "engineering judgement", judgement,
     limits_ours, bone, reamed_bone, percent_range, at_most(5.0, 15.0)},
    {"congruity_mm", "Congruity", "mm",
     "Mean distance of the reamed surface from the sphere that fits it best; not available where less than "
     "a tenth of it still has bone.",
     "'A 3-dimensional comparison of hand and power reamers in accuracy of glenoid retroversion correction': "
     "power reamer 0.08 mm (0.07 to 0.19), by hand 0.11",
     published, limits_ours, bone, reamed_bone, not_negative, at_most(0.2, 0.5)},
    {"fitted_radius_mm", "Radius of the reamed surface", "mm", "Radius of the sphere that fits it best.",
     no_limits, judgement, "uncertain where the footprint is small", bone, reamed_bone, not_negative,
     only_reported},
    {"plate_preserved_percent", "Subchondral plate preserved", "%",
     "Share of the component's footprint in which at least half of the plate is left along the planned axis; "
     "the plate is found by density, or taken as 1.9 mm thick where density does not show it.",
     "PubMed 29974217: removal increases micromotion (p = 0.043)", published,
     "within 2 points of the bone as it was imported in 100 seeded reamings, of the bone that was scanned "
     "within 10; limits are engineering judgement",
     bone, reamed_bone, percent_range, at_least(80.0, 60.0), no_aim, number, "plate_planned_percent"},
    {"plate_planned_percent", "Subchondral plate planned", "%",
     "Share of plate preserved if the plan is carried out exactly.", no_limits, judgement,
     "by the same measure", bone, untouched_bone, percent_range, only_reported},
    {"plate_lost_percent", "Plate lost beyond the plan", "%",
     "Share of the plate's bone that the plan leaves under the planned component, less the share that is "
     "left under the achieved one; 0 where that is more.",
     "PubMed 29974217: removal increases micromotion (p = 0.043); limits are engineering judgement",
     judgement, limits_ours, bone, reamed_bone, percent_range, at_most(10.0, 40.0)},
    {"plate_thickness_mm", "Subchondral plate thickness", "mm",
     "Median thickness of the plate under the native face, along the planned axis.",
     "Frich 1998: 1.9 mm (1.2 to 2.9)", published,
     "to 0.1 mm from 1.9 mm on; a plate thinner than the scan's blur reads thicker, 0.6 mm as 0.9 to 1.0",
     bone, untouched_bone, not_negative, only_reported},
    {"vault_distance_mm", "Vault distance, pegs", "mm",
     "Least distance of three virtual pegs on the seated component from the outer cortex of the vault; "
     "negative beyond it.",
     clavert, published, limits_ours, bone, reamed_bone, any, at_least(2.0, barely_mm)},
    {"vault_distance_keel_mm", "Vault distance, keel", "mm", "The same of a virtual keel.", clavert,
     published, limits_ours, bone, reamed_bone, any, at_least(2.0, barely_mm)},
    {"vault_distance_tool_mm", "Vault distance, reamer", "mm",
     "Least distance of the reamer's apex, or of its nipple's tip, at its deepest from the outer cortex.",
     clavert, published, limits_ours, bone, reamed_bone, any, at_least(2.0, barely_mm)},
    {"vault_distance_component_mm", "Vault distance, component", "mm",
     "Least distance of the pegs or the keel of the planned component, seated, from the outer cortex of the "
     "vault; negative beyond it.",
     clavert, published, own_component, bone, reamed_bone, any, at_least(2.0, barely_mm)},
    {"vault_breach_mm", "Vault breach", "mm",
     "How far the pegs or the keel of the planned component reach beyond the outer cortex; 0 where they do "
     "not.",
     clavert, published, own_component, bone, reamed_bone, not_negative, at_most(0.0, 0.0)},
    {"parts_through_vault", "Parts through the vault", "",
     "How many pegs or keels of the planned component leave the vault.", clavert, published, own_component,
     bone, reamed_bone, not_negative, at_most(0.0, 0.0)},
    {"vault_depth_mm", "Bone left in the vault", "mm",
     "Least bone left along the planned axis under the component's middle: within 6 mm of it, beside the "
     "pilot hole.",
     no_limits, judgement, "as exact as the vault's far wall in the scan", bone, reamed_bone, not_negative,
     only_reported},
    {"wall_thickness_least_mm", "Thinnest wall", "mm",
     "Least bone left behind what was reamed, along the normal of the reamed face (of the plane that fits it "
     "within 2.5 mm) to where the bone ends first; under the component without its outermost 3 mm.",
     wall_ours, judgement, wall_checked, bone, reamed_bone, not_negative, only_reported, Better::more},
    {"wall_thickness_thin_mm", "Thin wall, 5th percentile", "mm",
     "The thickness of wall that 5 % of those places fall below.", wall_ours, judgement, wall_checked, bone,
     reamed_bone, not_negative, only_reported, Better::more},
    {"perforated_area_mm2", "Perforation by the reamer", "mm2",
     "Of the component's footprint, where all bone is gone of what was at least 5 mm thick.", clavert,
     published, "up to 1 mm2 may be the edge of a ray", bone, reamed_bone, not_negative, at_most(0.0, 1.0)},
    {"axial_thrust_mean_n", "Mean thrust", "N",
     "Mean simulated thrust along the tool's axis while the reamer cuts with at least 5 N.", thesis,
     judgement, exact_sum, handling, episode, any, between(35.0, 70.0)},
    {"axial_thrust_sd_n", "Thrust, standard deviation", "N", "Standard deviation of the same.",
     "Faieghi 2018, 5.1: a robot keeps 52 N within 4.3 N", published, compare, handling, episode,
     not_negative, only_reported, Better::less},
    {"thrust_rate_percent_s", "Unevenness of thrust", "%/s",
     "Root mean square rate at which thrust changes, as a share of the mean thrust, over presses with at "
     "least 5 N while the spindle turns in contact: from one mean over 50 ms to the next, without the first "
     "and "
     "the last quarter of a second of each press. 0 for a steady thrust.",
     "Trejos 2014: derivatives of force as measures of skill; the low-pass and the division by the mean are "
     "ours",
     published, rate_checked, handling, episode, not_negative, only_reported, Better::less},
    {"axial_thrust_peak_n", "Peak thrust", "N",
     "Greatest thrust over the ticks in contact with the spindle on.", thesis, judgement, exact_sum, handling,
     ticks, any, at_most(104.0, 104.0)},
    {"axial_thrust_excess_n_s", "Excess thrust", "N s", "Integral of thrust beyond 78 N over those ticks.",
     thesis, judgement, exact_sum, handling, ticks, not_negative, only_reported, Better::less},
    {"overload_time_s", "Time over 78 N", "s", "Time of thrust beyond 78 N in contact with the spindle on.",
     thesis, judgement, exact_sum, handling, ticks, not_negative, at_most(0.5, 3.0)},
    {"axis_sd_deg", "Axis, standard deviation", "deg",
     "Root mean square distance of the tool's unit axis from its own mean direction, as an angle, while the "
     "reamer cuts with at least 5 N.",
     "engineering judgement: how steadily the hand holds", judgement, compare, handling, episode,
     not_negative, only_reported, Better::less},
    {"apparent_stiffness_n_mm", "Apparent stiffness", "N/mm",
     "Thrust gained a mm of advance while thrust first rises from 1 N to 90 % of 52 N.",
     "Faieghi 2018, 5.2: apparent machining stiffness", published, compare, handling, episode, positive,
     only_reported},
    {"breakthrough_advance_mm", "Breakthrough, advance", "mm",
     "How far the tool's apex advances along the planned axis from first pressing on cancellous bone (a "
     "tenth of what is engaged, at 5 N) until thrust falls below 5 N.",
     nigam, published, compare, handling, episode, not_negative, only_reported, Better::less},
    {"breakthrough_time_s", "Breakthrough, time", "s", "The time of it.", nigam, published, compare, handling,
     episode, not_negative, only_reported, Better::less},
    {"plate_overrun_mm", "Advance past the plate", "mm",
     "How far the tool's apex advances after it has gone through the cartilage (a tenth of what is engaged "
     "is bone) until thrust falls below 5 N.",
     "Strelzow 2023: experts feel the change from cartilage to bone in 77 % (SD 23); 1 mm is ours", published,
     "limit is engineering judgement", handling, episode, not_negative, at_most(1.0, 1.0)},
    {"surface_temperature_peak_c", "Peak temperature", "C",
     "Highest temperature of the bone's surface under the reamer.", eriksson, published, heat_model, handling,
     episode, any, at_most(47.0, 56.0)},
    {"time_over_47_s", "Time over 47 degrees", "s", "Time in which it was at 47 degrees or more.", eriksson,
     published, heat_model, handling, episode, not_negative, at_most(30.0, 60.0)},
    {"time_over_56_s", "Time over 56 degrees", "s", "Time in which it was at 56 degrees or more.", eriksson,
     published, heat_model, handling, episode, not_negative, at_most(0.0, 1.0)},
    {"heated_bone_depth_mm", "Depth of heated bone", "mm",
     "How deep below the reamed surface bone is left that was at 56 degrees or more; from the surface's "
     "temperature and the feed, in bone of 0.5 W/(m K) and 2.6 MJ/(m3 K).",
     "Olson 2011: over 1 mm (1.97 to 5.12) in 4 of 5 dry reamings; 0.5 mm is ours", published, heat_model,
     handling, episode, not_negative, at_most(0.5, 1.0)},
    {"passes", "Passes", "", "Episodes of contact with over 5 N; gaps of up to 0.5 s do not part them.",
     "engineering judgement", judgement, exact_sum, handling, ticks, not_negative, only_reported,
     Better::less},
    {"duration_s", "Duration", "s", "From the first tick to the last.", time_and_motion, published, exact_sum,
     handling, ticks, not_negative, only_reported, Better::less},
    {"contact_time_s", "Time in contact", "s", "Time in which the reamer touches bone.", time_and_motion,
     published, exact_sum, handling, ticks, not_negative, only_reported, Better::less},
    {"contact_spread_mm", "Spread of contact", "mm",
     "How far apart the places lie at which the reamer touched bone: the diagonal of the box around its "
     "apex.",
     "engineering judgement", judgement, exact_sum, handling, episode, not_negative, only_reported},
    {"weakened_time_s", "Time of weakened force", "s",
     "Time in which the hand felt noticeably less than was simulated.", "limits of the device", tested,
     exact_sum, handling, ticks, not_negative, only_reported},
    {"spindle_stalls", "Spindle stalls", "",
     "How often bone held the reamer still while the trigger was pressed: started under load, or pressed too "
     "hard.",
     "surgeons are taught to start the reamer before it touches bone", judgement, exact_sum, handling, ticks,
     not_negative, only_reported, Better::less},
    {"standing_press_time_s", "Pressed on with a standing reamer", "s",
     "Time in contact with at least 5 N while the spindle is off.",
     "surgeons are taught to start the reamer before it touches bone", judgement, exact_sum, handling, ticks,
     not_negative, only_reported, Better::less},
    {"air_spin_time_s", "Turning in the air", "s",
     "Time in which the spindle is on and the reamer touches no bone.", "engineering judgement", judgement,
     exact_sum, handling, ticks, not_negative, only_reported},
    {"withdrawn_spin_time_s", "Turning after a contact", "s",
     "Of the time of turning in the air, that after the first contact: between contacts, and after the last.",
     "engineering judgement", judgement, exact_sum, handling, ticks, not_negative, only_reported,
     Better::less},
    {"spindle_starts_in_contact", "Starts on the bone", "",
     "How often the spindle was started while the reamer touched bone.",
     "surgeons are taught to start the reamer before it touches bone", judgement, exact_sum, handling, ticks,
     not_negative, only_reported, Better::less},
    {"contact_before_spin_s", "Contact before spin", "s",
     "Time for which a standing reamer had touched bone when it was started there, with any force; breaks of "
     "up to 0.5 s part no contact. A standing reamer that is taken off the bone before it is started does "
     "not count: that is in 'Pressed on with a standing reamer'.",
     "surgeons are taught to start the reamer before it touches bone", judgement, exact_sum, handling, ticks,
     not_negative, only_reported, Better::less},
    {"idle_time_s", "Time between contacts", "s",
     "Time without contact between the first contact and the last.", time_and_motion, published, exact_sum,
     handling, ticks, not_negative, only_reported, Better::less},
    {"spindle_restarts", "Spindle restarts", "", "How often the spindle was started after the first time.",
     time_and_motion, published, exact_sum, handling, ticks, not_negative, only_reported, Better::less},
    {"extrapolated_time_s", "Time in bone nobody measured", "s",
     "Time of cutting bone whose mean density lies outside 0.41 to 0.72 and 1.30 to 1.61 g/cc, where the "
     "feed laws were measured.",
     "Faieghi 2018, table 5.1", tested, exact_sum, handling, ticks, not_negative, only_reported},
    {"path_in_contact_mm", "Path in contact", "mm",
     "Length of the way of the tool's apex in the bone's frame while it touches bone.", time_and_motion,
     published, exact_sum, handling, ticks, not_negative, only_reported, Better::less},
    {"path_out_of_contact_mm", "Path in the air", "mm", "The same while it does not.", time_and_motion,
     published, exact_sum, handling, ticks, not_negative, only_reported, Better::less},
    {"path_economy_contact_percent", "Economy of movement, in contact", "%",
     "How much deeper along the planned axis the tool's apex came while it touched bone, which is the "
     "shortest path that the cutting needs, over the path in contact.",
     economy, published, economy_checked, handling, episode, percent_range, only_reported, Better::more},
    {"path_economy_percent", "Economy of movement", "%",
     "The shortest path over the path of the whole session, from first approach to last withdrawal. The "
     "shortest goes straight from where the apex began to the deepest place at which bone was removed, and "
     "straight to where it ended.",
     economy, published, economy_checked, handling, episode, percent_range, only_reported, Better::more},
    {"strokes", "Strokes", "",
     "Movements of the tool's apex at over 1 mm/s for at least 0.2 s, ended by 0.1 s below that.",
     "engineering judgement", judgement, exact_sum, handling, ticks, not_negative, only_reported},
    {"sparc", "Smoothness, SPARC", "",
     "Mean spectral arc length over the strokes; more negative is less smooth.", balasubramanian, published,
     "to 1e-4 of the authors' program", handling, episode, any, only_reported, Better::more},
    {"ldlj", "Smoothness, LDLJ", "",
     "Mean log dimensionless jerk over the strokes; more negative is less smooth.", balasubramanian,
     published, "to 1e-4 of the authors' program", handling, episode, any, only_reported, Better::more},
};

}  // namespace

std::span<const Metric> metric_catalogue() { return catalogue; }

std::span<const Metric> metrics_of(MetricGroup group) {
  const auto is_of_group = [&](const Metric& m) { return m.group == group; };
  const auto* first = std::find_if(std::begin(catalogue), std::end(catalogue), is_of_group);
  return {first, std::find_if_not(first, std::end(catalogue), is_of_group)};
}

const Metric* find_metric(std::string_view key) {
  const auto* found =
      std::find_if(std::begin(catalogue), std::end(catalogue), [&](const Metric& m) { return m.key == key; });
  return found == std::end(catalogue) ? nullptr : found;
}

std::optional<Better> aim_of(const Metric& metric) {
  const Better better = metric.band.better;
  return better == Better::less || better == Better::more ? better : metric.aim;
}

std::string_view to_text(Evidence evidence) {
  constexpr std::string_view texts[] = {"S", "M", "E", "T"};
  return texts[static_cast<size_t>(evidence)];
}

}  // namespace ream::score
