#include "bench/validate/protocol.hpp"

#include "bench/validate/steady_reaming.hpp"
#include "core/clock.hpp"
#include "statistics/sample.hpp"

namespace ream::bench {
namespace {

constexpr double longest_s = 120.0;
constexpr double start_above_mm = 0.3;

device::Script robot_script(double start_mm, double depth_mm, double factor, double force_n) {
  device::Script script;
  script.kind = device::ScriptKind::robot;
  script.device_profile = "ideal-admittance";
  script.duration_s = longest_s;
  script.specimen_factor = factor;
  script.robot.start_mm = Vec3(0, 0, start_mm - start_above_mm);
  script.robot.force_n = force_n;
  script.robot.ramp_s = protocol_ramp_s;
  script.robot.depth_mm = depth_mm;
  return script;
}

/// Cancellous bone under a cortical layer.
voxel::BoneModel layered_slab(double cortical_g_cc, double cancellous_g_cc) {
  voxel::BoneModel bone = test::slab({96, 96, 96}, 0.15, slab_surface_mm, cancellous_g_cc);
  const uint8_t cortical = voxel::density_code(cortical_g_cc);
  for (int w = 0; w < bone.grid.dims.z(); ++w) {
    if (bone.grid.centre_mm({0, 0, w}).z() < slab_surface_mm - cortical_layer_mm) continue;
    for (int v = 0; v < bone.grid.dims.y(); ++v)
      for (int u = 0; u < bone.grid.dims.x(); ++u)
        bone.density.writable()[bone.grid.index(u, v, w)] = cortical;
  }
  return bone;
}

void take_cortical_away(voxel::BoneModel& bone) {
  for (size_t i = 0; i < bone.coverage.size(); ++i)
    if (voxel::density_g_cc(bone.density[i]) >= bone.cortical_threshold_g_cc) bone.coverage[i] = 0;
}

Phase phase_of(const sim::Model& model, const std::vector<record::TickReport>& reports, double force_n) {
  size_t touch = 0, deepest = 0;
  while (touch < reports.size() && !reports[touch].engaged) ++touch;
  Phase phase;
  const double touched_mm = apex_mm(model, reports[touch]);
  for (size_t i = touch; i < reports.size(); ++i)
    if (apex_mm(model, reports[i]) > apex_mm(model, reports[deepest])) deepest = i;
  for (size_t i = touch; i <= deepest; ++i)
    phase.ticks.push_back({reports[i].thrust_n, apex_mm(model, reports[i]) - touched_mm});

  std::vector<double> held_n;
  const double full_n = 0.999 * force_n, most_n = 0.9 * force_n;
  const ProtocolTick *first = nullptr, *last = nullptr, *held_from = nullptr;
  for (const ProtocolTick& tick : phase.ticks) {
    if (!first && tick.thrust_n >= force::start_threshold_n) first = &tick;
    if (!last && tick.thrust_n >= most_n) last = &tick;
    if (!held_from && tick.thrust_n >= full_n) held_from = &tick;
    if (held_from) held_n.push_back(tick.thrust_n);
  }
  if (!held_from || held_n.size() < 2) return phase;
  phase.held_thrust_n = statistics::mean_of(held_n);
  phase.held_feed_mm_s = (phase.ticks.back().advance_mm - held_from->advance_mm) /
                         (static_cast<double>(held_n.size() - 1) * tick_s);
  phase.stiffness_n_mm = (last->thrust_n - first->thrust_n) / (last->advance_mm - first->advance_mm);
  return phase;
}

/// One phase on `bone`, which it changes.
Phase run_phase(voxel::BoneModel& bone, const device::Script& script) {
  const case_::Plan plan = test::slab_plan(bone, slab_surface_mm);
  test::SmallRun run(std::move(bone), plan, slab_reamer, script);
  const auto reports = run.run();
  bone = run.bone;
  return phase_of(run.model, reports, script.robot.force_n);
}

}  // namespace

SpecimenRun run_protocol(size_t index, const PhaseForces& forces) {
  const Specimen &cortical = published_cortical.specimens[index],
                 &cancellous = published_cancellous.specimens[index];
  voxel::BoneModel bone = layered_slab(cortical.density_g_cc, cancellous.density_g_cc);
  SpecimenRun run;
  run.cortical = run_phase(
      bone,
      robot_script(0.0, cortical_depth_mm, specimen_factor(published_cortical, cortical), forces.cortical_n));
  take_cortical_away(bone);
  run.cancellous =
      run_phase(bone, robot_script(cortical_layer_mm, cancellous_depth_mm,
                                   specimen_factor(published_cancellous, cancellous), forces.cancellous_n));
  return run;
}

}  // namespace ream::bench
