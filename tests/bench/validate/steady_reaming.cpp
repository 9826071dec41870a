#include "bench/validate/steady_reaming.hpp"

#include "core/clock.hpp"

namespace ream::bench {
namespace {

constexpr size_t measured_ticks = 1000;
constexpr double run_s = 3.0;

}  // namespace

test::SmallRun slab_run(double density_g_cc, const device::Script& script) {
  voxel::BoneModel bone = test::slab({96, 96, 96}, 0.15, slab_surface_mm, density_g_cc);
  const case_::Plan plan = test::slab_plan(bone, slab_surface_mm);
  return {std::move(bone), plan, slab_reamer, script};
}

double apex_mm(const sim::Model& model, const record::TickReport& report) {
  return model.world_from_plan.inverse().point(report.world_from_tool.translation_mm).z();
}

SteadyReaming steady_reaming(double density_g_cc, double force_n, double specimen_factor,
                             const char* device_profile) {
  device::Script script = test::steady_push(force_n, run_s);
  script.device_profile = device_profile;
  script.specimen_factor = specimen_factor;
  test::SmallRun run = slab_run(density_g_cc, script);
  const auto reports = run.run();
  const size_t first = reports.size() - measured_ticks;
  SteadyReaming steady;
  steady.feed_mm_s = (apex_mm(run.model, reports.back()) - apex_mm(run.model, reports[first - 1])) /
                     (static_cast<double>(measured_ticks) * tick_s);
  double least_n = 1e9, most_n = 0.0, sum_n = 0.0;
  for (size_t i = first; i < reports.size(); ++i) {
    const double hand_n = reports[i].hand_force_n.norm();
    least_n = std::min(least_n, hand_n);
    most_n = std::max(most_n, hand_n);
    sum_n += hand_n;
    steady.thrust_n += reports[i].thrust_n / static_cast<double>(measured_ticks);
  }
  steady.ripple_percent = 100.0 * (most_n - least_n) * static_cast<double>(measured_ticks) / sum_n;
  return steady;
}

}  // namespace ream::bench
