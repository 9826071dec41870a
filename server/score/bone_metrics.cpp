#include "score/metric_groups.hpp"

namespace ream::score {
namespace {

constexpr std::string_view exact_sum =
    "an exact sum over ticks; within 0.5 % of the truth in seeded reamings";
constexpr std::string_view half_voxel = "within half a voxel of the truth in 100 seeded reamings";
constexpr std::string_view limits_ours = "limits are engineering judgement";
constexpr std::string_view clavert =
    "Clavert 2007 (perforation); the limit of 2 mm and the sizes of peg and keel are ours";
constexpr std::string_view no_limits = "reported without limits";
// A distance of exactly nothing is a breach.
constexpr double barely_mm = 1e-6;

constexpr Metric metrics[] = {
    {"removed_volume_mm3", "Volume removed", "mm3", "Bone and cartilage removed, the pilot hole left out.",
     no_limits, Evidence::tested, exact_sum, only_reported},
    {"removed_volume_cortical_mm3", "Cortical volume removed", "mm3",
     "Of it, voxels at least as dense as the threshold of cortical bone.", no_limits, Evidence::tested,
     exact_sum, only_reported},
    {"removed_volume_cancellous_mm3", "Cancellous volume removed", "mm3", "Of it, bone below that threshold.",
     no_limits, Evidence::tested, exact_sum, only_reported},
    {"removed_volume_cartilage_mm3", "Cartilage volume removed", "mm3", "Of it, cartilage.", no_limits,
     Evidence::tested, exact_sum, only_reported},
    {"reaming_depth_mm", "Reaming depth", "mm",
     "How far the tool's apex went along the planned axis from first contact while removing.", no_limits,
     Evidence::tested, "exact but for where contact begins", only_reported},
    {"depth_max_mm", "Greatest depth", "mm",
     "Greatest depth of removed bone and cartilage along the planned axis over the face, where bone is left "
     "under it and without the pilot hole.",
     "Frich 1998: plate of 1.9 mm; limits stand with medialization", Evidence::judgement, half_voxel,
     only_reported},
    {"depth_mean_mm", "Mean depth", "mm",
     "Mean depth of removed bone and cartilage along the planned axis, over where at least 0.05 mm is gone.",
     no_limits, Evidence::judgement, half_voxel, only_reported},
    {"medialization_mm", "Medialization", "mm",
     "Greatest depth along the planned axis past the native subchondral surface, which is the bone under any "
     "cartilage.",
     "Frich 1998: plate of 1.9 mm (1.2 to 2.9)", Evidence::judgement, limits_ours, at_most(2.0, 3.0)},
    {"footprint_area_mm2", "Footprint", "mm2",
     "Area across the planned axis in which at least 0.05 mm of the face is gone.", no_limits,
     Evidence::judgement, "counted on a lattice of 0.25 mm", only_reported},
    {"seating_percent", "Seating", "%",
     "Share of the implant's back that lies within 0.5 mm of the reamed face. The back is a sphere of the "
     "implant's radius (without one, the reamer's own shape), half a millimetre narrower all around than the "
     "reamer, trimmed to the native face and without the pilot hole; pressed along the achieved axis until 1 "
     "% of it would have to sink "
     "in.",
     "Lazarus 2002 (share supported by bone); 0.5 mm, 80 % and 90 % are ours", Evidence::judgement,
     "within 1 point of the truth in 100 seeded reamings; limits are engineering judgement",
     at_least(90.0, 80.0)},
    {"congruity_mm", "Congruity", "mm",
     "Mean distance of the reamed surface from the sphere that fits it best; not said where less than a "
     "tenth "
     "of it still has bone.",
     "siftdesk: power reamer 0.08 mm (0.07 to 0.19), by hand 0.11", Evidence::published, limits_ours,
     at_most(0.2, 0.5)},
    {"fitted_radius_mm", "Radius of the reamed surface", "mm", "Radius of the sphere that fits it best.",
     no_limits, Evidence::judgement, "uncertain where the footprint is small", only_reported},
    {"plate_preserved_percent", "Subchondral plate preserved", "%",
     "Share of the component's footprint in which at least half of the plate is left along the planned axis; "
     "the plate is found by density, or taken as 1.9 mm thick where density does not show it.",
     "readbyqxmd 29974217: removal increases micromotion (p = 0.043)", Evidence::published,
     "within 2 points of the truth in 100 seeded reamings; limits are engineering judgement",
     at_least(80.0, 60.0)},
    {"plate_thickness_mm", "Subchondral plate thickness", "mm",
     "Median thickness of the plate under the native face, along the planned axis.",
     "Frich 1998: 1.9 mm (1.2 to 2.9)", Evidence::published, "as sharp as the scan", only_reported},
    {"vault_distance_mm", "Vault distance, pegs", "mm",
     "Least distance of three virtual pegs on the seated component from the outer cortex of the vault; "
     "negative beyond it.",
     clavert, Evidence::published, limits_ours, at_least(2.0, barely_mm)},
    {"vault_distance_keel_mm", "Vault distance, keel", "mm", "The same of a virtual keel.", clavert,
     Evidence::published, limits_ours, at_least(2.0, barely_mm)},
    {"vault_distance_tool_mm", "Vault distance, reamer", "mm",
     "Least distance of the reamer's apex, or of its nipple's tip, at its deepest from the outer cortex.",
     clavert, Evidence::published, limits_ours, at_least(2.0, barely_mm)},
    {"vault_breach_mm", "Vault breach", "mm",
     "How far the pegs reach beyond the outer cortex; 0 where they do not.", clavert, Evidence::published,
     "any breach is critical", at_most(0.0, 0.0)},
};

}  // namespace

std::span<const Metric> bone_metrics() { return metrics; }

}  // namespace ream::score
