#include "sim/model.hpp"

#include "core/error.hpp"
#include "core/process_memory.hpp"
#include "force/edge_load.hpp"
#include "sim/cutting_surface.hpp"
#include "sim/guided_handle.hpp"
#include "sim/scapula_mount.hpp"

namespace ream::sim {

Pose world_from_plan(const case_::Plan& plan) {
  return {rotation_with_z_along(plan.axis_direction), plan.entry_mm};
}

Model make_model(const case_::Plan& plan, voxel::BoneModel& bone, shell::Tool tool,
                 const Settings& settings) {
  case_::cut_pilot_hole(bone, plan);
  prefer_huge_pages(bone.coverage.data(), bone.coverage.size());
  prefer_huge_pages(bone.density.data(), bone.density.size());
  Model model;
  model.settings = settings;
  model.plan = plan;
  model.world_from_plan = world_from_plan(plan);
  model.tool = std::move(tool);
  model.profile =
      shell::swept_profile(model.tool.profile, collide::RemovalSchedule::needed_margin_mm(bone.grid));
  const shell::PointShell points = shell::make_point_shell(model.tool, settings.tool_spacing_mm);
  const bool by_decay = settings.removal == RemovalLaw::decay;
  model.contact_shell = collide::make_contact_shell(
      points, bone.grid.spacing_mm.maxCoeff(),
      by_decay ? collide::ContactRule::one_voxel_out : collide::ContactRule::at_surface);
  model.resistances = force::edge_resistances(voxel::density_step_g_cc, voxel::cartilage_code);
  if (by_decay) model.decay_shell = collide::make_decay_shell(points);
  model.distance = voxel::brick_distance(bone);
  if (model.distance.nothing())
    throw Error(ErrorKind::invalid_input, "the case holds no bone; import it again with a lower threshold");
  model.surface_place = SurfacePlace(model.tool.profile);
  model.tool_box_tool = model.contact_shell.bounds_mm;
  const double r = model.profile.max_radius_mm;
  model.tool_box_tool.include(Vec3(-r, -r, model.profile.body_min_z_mm));
  model.tool_box_tool.include(Vec3(r, r, model.profile.body_max_z_mm));
  model.vibration = force::make_vibration_tracks(settings.vibration, settings.random_seed);
  for (size_t k = 0; k < 3 && settings.vibration.source == force::VibrationSource::synthesized; ++k)
    model.vibration_of_specimen[k] =
        force::specimen_vibration(static_cast<force::VibrationKind>(k), settings.random_seed);
  model.feed = force::make_feed_model(settings.feed, cutting_lip(model.tool.profile));
  model.virtual_mass = settings.virtual_mass;
  model.coupling = settings.virtual_mass
                       ? force::coupling_of(*settings.virtual_mass, settings.force_scale)
                       : force::CouplingParameters{settings.stiffness_n_mm,
                                                   settings.angular_stiffness_n_mm_rad, settings.force_scale};
  model.guide = make_guide(model);
  model.mount = stable_mount(model);
  model.thin_step_mm = bone.grid.min_spacing_mm();
  // Half a voxel's diagonal, and one to the voxel next to a probe's.
  model.contact_reach_mm = 2.0 * bone.grid.spacing_mm.maxCoeff();
  return model;
}

}  // namespace ream::sim
