#include "bench/heat_rows.hpp"

#include <algorithm>
#include <ostream>

#include "score/heating.hpp"
#include "support/analytic_glenoid.hpp"
#include "support/small_run.hpp"

namespace ream::bench {
namespace {

constexpr double heated_voxel_mm = 0.6, cooling_s = 20.0;
/// Under arthritic faces hard bone reaches 4.5 mm down (Simon 2014).
constexpr double sclerotic_plate_mm = 4.5;

struct HeatedReaming {
  double thrust_n, rpm, seconds;
};
/// In times that leave something of the plate.
constexpr HeatedReaming five_heated[] = {
    {52, 156, 60}, {52, 200, 50}, {65, 200, 40}, {75, 156, 45}, {80, 250, 30}};

struct Warmed {
  double peak_c = 0.0, dead_mm = 0.0;
  double power_w = 0.0, area_mm2 = 0.0, feed_mm_s = 0.0;  ///< means while it cuts
};

Warmed warmed_by(const HeatedReaming& reaming, bool irrigated) {
  test::AnalyticGlenoid glenoid;
  glenoid.plate_mm = sclerotic_plate_mm;
  const test::AnalyticGlenoid::Frame face = glenoid.frame();
  case_::Plan plan;
  plan.axis_direction = glenoid.mirrored(-face.n);
  plan.entry_mm = glenoid.mirrored(face.centre);
  plan.pilot_hole.reset();
  device::Script script = test::steady_push(reaming.thrust_n, reaming.seconds + cooling_s);
  script.spindle_rpm = reaming.rpm;
  script.hand.force_profile = {
      {0.0, reaming.thrust_n}, {reaming.seconds, reaming.thrust_n}, {reaming.seconds + 0.1, -20.0}};
  script.buttons = {{0.0, true, false, {255, false, irrigated}}};
  auto settings = test::SmallRun::settings(script, "cpu", sim::RemovalLaw::profile, force::FeedKind::edge);
  settings.tool_spacing_mm = 0.6;
  test::SmallRun run(test::bone_of(glenoid, heated_voxel_mm), plan, "thesis-appendix-a", script, settings);
  Warmed warmed;
  score::Heating heating;
  int64_t cutting = 0;
  for (const record::TickReport& r : run.run()) {
    heating.add(r);
    if (!r.cutting) continue;
    ++cutting;
    warmed.power_w += 1e-3 * r.spindle_torque_n_mm * rad_s_from_rpm(reaming.rpm);
    warmed.area_mm2 += static_cast<double>(r.engaged_points) * run.model.contact_shell.cell_area_mm2;
    warmed.feed_mm_s += r.feed_rate_mm_s;
  }
  for (double* sum : {&warmed.power_w, &warmed.area_mm2, &warmed.feed_mm_s})
    *sum /= static_cast<double>(std::max<int64_t>(cutting, 1));
  score::MetricResults results;
  heating.write(results);
  warmed.peak_c = results.value("surface_temperature_peak_c").value_or(0.0);
  warmed.dead_mm = results.value("heated_bone_depth_mm").value_or(0.0);
  return warmed;
}

}  // namespace

void add_heat_rows(const Options& options, std::vector<Row>& rows) {
  int dry_over = 0, wet_over = 0;
  std::vector<double> dead_mm;
  for (const HeatedReaming& reaming : five_heated)
    for (const bool irrigated : {false, true}) {
      const Warmed warmed = warmed_by(reaming, irrigated);
      (irrigated ? wet_over : dry_over) += warmed.peak_c > 56.0 ? 1 : 0;
      if (!irrigated) dead_mm.push_back(warmed.dead_mm);
      if (options.tables)
        *options.tables << reaming.thrust_n << " N, " << reaming.rpm << " rpm, " << reaming.seconds << " s, "
                        << (irrigated ? "irrigated: " : "dry: ") << warmed.peak_c << " C, 56 C to "
                        << warmed.dead_mm << " mm; " << warmed.power_w << " W on " << warmed.area_mm2
                        << " mm2 at " << warmed.feed_mm_s << " mm/s" << std::endl;
    }
  std::sort(dead_mm.begin(), dead_mm.end());
  rows.push_back({"truth", "dry reamings over 56 degrees, of five (Olson 2011: 4)",
                  static_cast<double>(dry_over), 4.0, "", 4.0, Goal::at_least});
  rows.push_back({"truth",
                  "depth of bone left that was at 56 degrees, median of five dry reamings (Olson: 2 to 5)",
                  dead_mm[dead_mm.size() / 2], 0.0, "mm"});
  rows.push_back(
      {"truth", "irrigated reamings over 56 degrees, of five", static_cast<double>(wet_over), 0.0, "", 0.5});
}

}  // namespace ream::bench
