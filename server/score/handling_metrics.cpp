#include "score/metric_groups.hpp"

namespace ream::score {
namespace {

constexpr std::string_view exact_sum = "an exact sum over ticks";
constexpr std::string_view thesis = "52 N of the thesis; factors 2/3 to 4/3, 1.5 and 2 are ours";
constexpr std::string_view time_and_motion = "OSATS, time and motion";
constexpr std::string_view balasubramanian =
    "Balasubramanian 2015, of tip speed at 100 Hz; tested by its authors for discrete movements only";
constexpr std::string_view nigam =
    "Nigam 2022: experts cut force before the far layer; overshoot did not separate groups, time did (4.0 "
    "and "
    "10.0 s)";
constexpr std::string_view compare = "to be compared with experts on the same simulator";

constexpr Metric metrics[] = {
    {"axial_thrust_mean_n", "Mean thrust", "N",
     "Mean simulated thrust along the tool's axis over the ticks in contact with the spindle on.", thesis,
     Evidence::judgement, exact_sum, between(35.0, 70.0)},
    {"axial_thrust_peak_n", "Peak thrust", "N", "Greatest of those.", thesis, Evidence::judgement, exact_sum,
     at_most(104.0, 104.0)},
    {"axial_thrust_excess_n_s", "Excess thrust", "N s", "Integral of thrust beyond 78 N over those ticks.",
     thesis, Evidence::judgement, exact_sum, only_reported},
    {"apparent_stiffness_n_mm", "Apparent stiffness", "N/mm",
     "Thrust gained a mm of advance while thrust first rises from 1 N to 90 % of 52 N.",
     "thesis 5.2, apparent machining stiffness", Evidence::published, compare, only_reported},
    {"breakthrough_advance_mm", "Breakthrough, advance", "mm",
     "How far the tool's apex advances along the planned axis from first pressing on cancellous bone (a "
     "tenth "
     "of what is engaged, at 5 N) until thrust falls below 5 N.",
     nigam, Evidence::published, compare, only_reported},
    {"breakthrough_time_s", "Breakthrough, time", "s", "The time of it.", nigam, Evidence::published, compare,
     only_reported},
    {"plate_overrun_mm", "Advance past the plate", "mm",
     "How far the tool's apex advances after it has gone through the cartilage (a tenth of what is engaged "
     "is "
     "bone) until thrust falls below 5 N.",
     "Strelzow 2023: experts feel the change from cartilage to bone in 77 % (SD 23); 1 mm is ours",
     Evidence::published, "limit is engineering judgement", at_most(1.0, 1.0)},
    {"passes", "Passes", "", "Episodes of contact with over 5 N; gaps of up to 0.5 s do not part them.",
     "engineering judgement", Evidence::judgement, exact_sum, only_reported},
    {"duration_s", "Duration", "s", "From the first tick to the last.", time_and_motion, Evidence::published,
     exact_sum, only_reported},
    {"contact_time_s", "Time in contact", "s", "Time in which the reamer touches bone.", time_and_motion,
     Evidence::published, exact_sum, only_reported},
    {"weakened_time_s", "Time of weakened force", "s",
     "Time in which the hand felt noticeably less than was simulated.", "limits of the device",
     Evidence::tested, exact_sum, only_reported},
    {"path_in_contact_mm", "Path in contact", "mm",
     "Length of the way of the tool's apex in the bone's frame while it touches bone.", time_and_motion,
     Evidence::published, exact_sum, only_reported},
    {"path_out_of_contact_mm", "Path in the air", "mm", "The same while it does not.", time_and_motion,
     Evidence::published, exact_sum, only_reported},
    {"strokes", "Strokes", "",
     "Movements of the tool's apex at over 1 mm/s for at least 0.2 s, ended by 0.1 s below that.",
     "engineering judgement", Evidence::judgement, exact_sum, only_reported},
    {"sparc", "Smoothness, SPARC", "",
     "Mean spectral arc length over the strokes; more negative is less smooth.", balasubramanian,
     Evidence::published, "to 1e-4 of the authors' program", only_reported},
    {"ldlj", "Smoothness, LDLJ", "",
     "Mean log dimensionless jerk over the strokes; more negative is less smooth.", balasubramanian,
     Evidence::published, "to 1e-4 of the authors' program", only_reported},
};

}  // namespace

std::span<const Metric> handling_metrics() { return metrics; }

}  // namespace ream::score
