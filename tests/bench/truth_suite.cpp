#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ostream>

#include "bench/bench.hpp"
#include "bench/heat_rows.hpp"
#include "score/depth_gauge.hpp"
#include "sim/step.hpp"
#include "support/reaming_setup.hpp"
#include "support/way_out.hpp"

namespace ream::bench {
namespace {

constexpr uint32_t gauge_ticks = 100;
constexpr double same_place_mm = 0.002;

/// One reaming, looked at ten times a second.
struct Gauged {
  double worst_mm = 0.0;                 ///< gauge from truth, at any look
  double gauge_mm = 0.0, true_mm = 0.0;  ///< at the end
  uint32_t cutting_ticks = 0, before_contact_ticks = 0;
  test::WayOut way_out;

  double before_contact_percent() const {
    return cutting_ticks > 0 ? 100.0 * before_contact_ticks / cutting_ticks : 0.0;
  }
};

Gauged ream(const test::RandomReaming& reaming, double voxel_mm) {
  const test::TemporaryFolder folder;
  session::Simulation simulation(test::setup_of(reaming, voxel_mm, folder));
  const voxel::BoneModel& bone = simulation.bone_case.bone;
  score::DepthGauge gauge(simulation.native);
  test::DepthTruth truth(reaming);
  Gauged gauged;
  Vec3 last_mm = Vec3::Constant(1e9);
  bool touched = false;
  simulation.device->open();
  device::DeviceInput input;
  while (simulation.device->read(input) == device::DeviceStatus::ok) {
    record::TickReport report;
    if (sim::step(simulation.model, simulation.state, input, report) != sim::StepStatus::ok) break;
    simulation.device->write(sim::output_of(report));
    const bool removed = report.changed_bricks > 0;
    touched = touched || (report.engaged && truth.touches(report.world_from_tool));
    gauged.cutting_ticks += report.cutting;
    gauged.before_contact_ticks += report.cutting && !touched;
    gauged.way_out.follow(report, input.hand_force_n);
    if (removed && (report.world_from_tool.translation_mm - last_mm).norm() > same_place_mm) {
      truth.cut_at(report.world_from_tool);
      last_mm = report.world_from_tool.translation_mm;
    }
    if (report.tick % gauge_ticks != 0) continue;
    gauged.gauge_mm = gauge.measure({bone.grid, bone.coverage.data()});
    gauged.true_mm = truth.depth_mm();
    gauged.worst_mm = std::max(gauged.worst_mm, std::abs(gauged.gauge_mm - gauged.true_mm));
  }
  simulation.device->close();
  return gauged;
}

/// The same reaming straight down the plan, to its depth: by an arm stiff enough that the reamer cannot walk
/// aside, as what is asked is where a reaming along the plan ends.
test::RandomReaming to_the_plan(test::RandomReaming reaming) {
  auto& robot = reaming.script["robot"];
  robot["start_mm"] = {0.0, 0.0, -5.0};
  robot["tilt_deg"] = {0.0, 0.0, 0.0};
  robot["depth_mm"] = reaming.plan.depth_mm;
  robot["line_stiffness_n_mm"] = 1000.0;
  return reaming;
}

/// How many reamings of each voxel size; REAM_REAMINGS says otherwise.
unsigned reamings() {
  const char* wanted = std::getenv("REAM_REAMINGS");
  return wanted ? static_cast<unsigned>(std::max(1, std::atoi(wanted))) : 50u;
}

void add_rows(double voxel_mm, const Options& options, std::vector<Row>& rows) {
  Gauged worst, planned;
  double early_percent = 0.0, held_s = 0.0, lost_mm3 = 0.0;
  const auto mm3 = [&](const Gauged& one) {
    return static_cast<double>(one.way_out.removed_levels()) / 255.0 * voxel_mm * voxel_mm * voxel_mm;
  };
  for (unsigned seed = 0; seed < reamings(); ++seed) {
    const test::RandomReaming reaming = test::random_reaming(seed, voxel_mm);
    const Gauged free = ream(reaming, voxel_mm), guided = ream(to_the_plan(reaming), voxel_mm);
    if (options.tables)
      *options.tables << voxel_mm << " mm, seed " << seed << ", " << reaming.plan.reamer << ": gauge off by "
                      << free.worst_mm << " mm at worst, " << free.gauge_mm << " of " << free.true_mm
                      << " mm at the end; to the plan " << guided.gauge_mm << " of " << reaming.plan.depth_mm
                      << " mm; cutting before contact " << free.before_contact_percent()
                      << " %; removed on the way out " << mm3(free) << " and " << mm3(guided) << " mm3; free "
                      << free.way_out.seconds_to_be_free() << " and " << guided.way_out.seconds_to_be_free()
                      << " s after drawing back" << std::endl;
    for (const Gauged& one : {free, guided}) {
      worst.worst_mm = std::max(worst.worst_mm, one.worst_mm);
      early_percent = std::max(early_percent, one.before_contact_percent());
      held_s = std::max(held_s, one.way_out.seconds_to_be_free());
      lost_mm3 = std::max(lost_mm3, mm3(one));
    }
    planned.worst_mm = std::max(planned.worst_mm, std::abs(guided.gauge_mm - reaming.plan.depth_mm));
  }
  const double gauge_goal_mm = std::max(0.1, 0.25 * voxel_mm), early_goal_percent = 2.0;
  const std::string of =
      ", " + std::to_string(reamings()) + " reamings at " + std::to_string(voxel_mm).substr(0, 3) + " mm";
  rows.push_back({"truth", "depth gauge from what is gone, at any tenth of a second" + of, worst.worst_mm,
                  0.0, "mm", gauge_goal_mm});
  rows.push_back({"truth", "depth gauge from the plan after a robot went to its depth" + of, planned.worst_mm,
                  0.0, "mm", gauge_goal_mm});
  rows.push_back({"truth", "cutting time before the reamer touches bone" + of, early_percent, 0.0, "%",
                  early_goal_percent});
  rows.push_back({"truth", "time from drawing back to being free of bone" + of, held_s, 0.0, "s", 0.5});
  rows.push_back({"truth", "bone removed on the way out" + of, lost_mm3, 0.0, "mm3", 0.1});
}

}  // namespace

std::vector<Row> truth_suite(const Options& options) {
  std::vector<Row> rows;
  for (const double voxel_mm : {0.6, 0.2, 0.1}) add_rows(voxel_mm, options, rows);
  add_heat_rows(options, rows);
  return rows;
}

}  // namespace ream::bench
