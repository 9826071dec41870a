#include "session/simulation/simulation.hpp"

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/version.hpp"

namespace ream::session {
namespace {

nlohmann::json vibration_json(const sim::Model& model) {
  const force::VibrationSettings& vibration = model.settings.vibration;
  nlohmann::json described = {{"source", force::to_text(vibration.source)},
                              {"seed", model.settings.random_seed},
                              {"n_per_g", vibration.vibration_n_per_g}};
  if (model.vibration) described["tracks_hash"] = to_hex(model.vibration->hash());
  return described;
}

nlohmann::json guide_json(const sim::Model& model) {
  nlohmann::json described = {{"kind", case_::to_text(model.plan.guide)}};
  if (model.guide) {
    described["clearance_mm"] = model.guide->clearance_mm;
    described["length_mm"] = model.guide->length_mm;
  }
  return described;
}

std::string model_name(const force::FeedSettings& feed) {
  return feed.plugin ? feed.plugin->name + " " + feed.plugin->version : force::to_text(feed.kind);
}

nlohmann::json mount_json(const sim::Model& model) {
  if (!model.mount) return "rigid";
  const auto list = [](const Vec3& v) { return nlohmann::json{v.x(), v.y(), v.z()}; };
  return {{"stiffness_n_mm", list(model.mount->stiffness_n_mm)},
          {"damping_n_s_mm", list(model.mount->damping_n_s_mm)},
          {"angular_stiffness_n_mm_rad", list(model.mount->angular_stiffness_n_mm_rad)},
          {"angular_damping_n_mm_s_rad", list(model.mount->angular_damping_n_mm_s_rad)}};
}

}  // namespace

const case_::Plan& plan_of(const case_::Case& c) {
  if (!c.plan)
    throw Error(ErrorKind::conflict, "case '" + c.id + "' has no plan; make one with `ream plan " + c.id +
                                         " --axis X,Y,Z,DX,DY,DZ`");
  return *c.plan;
}

Simulation::Simulation(SimulationSetup parts)
    : request(std::move(parts.request)),
      script(std::move(parts.script)),
      bone_case(std::move(parts.bone_case)),
      case_hash(parts.case_hash),
      anatomy(std::move(parts.anatomy)),
      native(std::move(parts.native)),
      reamer(std::move(parts.reamer)),
      device(std::move(parts.device)),
      link(std::move(parts.link)),
      model(sim::make_model(plan_of(bone_case), bone_case.bone, std::move(parts.tool), parts.settings)),
      state(model, bone_case.bone, parts.from) {}

nlohmann::json Simulation::description() const {
  nlohmann::json description = {
      {"build", version_text()},
      {"physics", model.settings.physics},
      {"case", bone_case.id},
      {"case_name", bone_case.name},
      {"side", case_::to_text(bone_case.side)},
      {"script", request.script_name},
      {"tool", model.tool.name},
      {"tool_spacing_mm", model.settings.tool_spacing_mm},
      {"shell_points", model.contact_shell.size()},
      {"backend", state.backend.name},
      {"removal", sim::to_text(model.settings.removal)},
      {"device_profile", device->traits().profile},
      {"force_scale", model.settings.force_scale},
      {"stiffness_n_mm", model.settings.stiffness_n_mm},
      {"model", model_name(model.settings.feed)},
      {"spindle_rpm", script.spindle_rpm},
      {"specimen_factor", model.settings.feed.specimen_factor},
      {"vibration", vibration_json(model)},
      {"guide", guide_json(model)},
      {"mount", mount_json(model)},
      {"random_seed", model.settings.random_seed},
      {"grid_dims",
       {bone_case.bone.grid.dims.x(), bone_case.bone.grid.dims.y(), bone_case.bone.grid.dims.z()}},
      {"start_grid_hash", to_hex(bone_case.bone.coverage_hash())}};
  if (model.settings.removal == sim::RemovalLaw::decay)
    description["decay_levels"] = model.settings.decay_levels;
  if (const auto& plugin = model.settings.feed.plugin)
    description["plugin"] = {
        {"name", plugin->name}, {"version", plugin->version}, {"sha256", plugin->sha256}};
  if (const uint64_t hash = model.feed->table_hash(); hash != 0)
    description["feed_table_hash"] = to_hex(hash);
  return description;
}

}  // namespace ream::session
