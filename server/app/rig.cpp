#include "app/rig.hpp"

#include <nlohmann/json.hpp>

#include "app/case_shelf.hpp"
#include "app/cli/case_path.hpp"
#include "app/data_folder.hpp"
#include "app/measured_glenoid.hpp"
#include "app/version.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/units.hpp"
#include "ct/phantom_case.hpp"
#include "sim/device_settings.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

force::VibrationSettings vibration_settings(const device::ScriptVibration& script) {
  force::VibrationSettings settings;
  settings.source = force::vibration_source_from(script.source);
  settings.recordings = {script.cortical_file, script.cancellous_file, script.idle_file, script.rate_hz};
  settings.vibration_n_per_g = script.n_per_g;
  return settings;
}

sim::Settings settings_for(const RunRequest& request, const device::Script& script,
                           const device::DeviceTraits& traits) {
  sim::Settings settings;
  settings.backend = request.backend;
  settings.removal = request.removal;
  settings.tool_spacing_mm = request.tool_spacing_mm;
  settings.force_scale = script.force_scale;
  settings.vibration = vibration_settings(script.vibration);
  sim::fit_to_device(traits, script.stiffness_n_mm, settings);
  settings.mount = script.mount;
  settings.random_seed = request.random_seed;
  settings.feed.kind =
      force::feed_kind_from_text(request.feed_model.empty() ? script.feed_model : request.feed_model);
  settings.feed.spindle_rad_s = rad_s_from_rpm(script.spindle_rpm);
  settings.feed.specimen_factor = script.specimen_factor;
  return settings;
}

nlohmann::json vibration_json(const sim::Model& model) {
  const force::VibrationSettings& vibration = model.settings.vibration;
  nlohmann::json json = {{"source", force::to_text(vibration.source)},
                         {"seed", model.settings.random_seed},
                         {"n_per_g", vibration.vibration_n_per_g}};
  if (model.vibration) json["tracks_hash"] = to_hex(model.vibration->hash());
  return json;
}

nlohmann::json guide_json(const sim::Model& model) {
  nlohmann::json json = {{"kind", case_::to_text(model.plan.guide)}};
  if (model.guide) {
    json["clearance_mm"] = model.guide->clearance_mm;
    json["length_mm"] = model.guide->length_mm;
  }
  return json;
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

case_::Case find_case(const std::string& name, const fs::path& data) {
  static CaseShelf shelf;
  if (name != "demo") return shelf.load(case_path(name, data));
  const fs::path demo = cases_folder(data) / "demo";
  if (!fs::exists(demo / "case.json")) ct::load_or_make_demo_case(data);
  return shelf.load(demo);
}

case_::Anatomy find_anatomy(const case_::Case& c, const std::string& name, const fs::path& data) {
  return case_::anatomy_of(c, name == "demo" ? cases_folder(data) / "demo" : case_path(name, data));
}

device::Script find_script(const RunRequest& request) {
  device::Script script = request.script_name == "demo"       ? device::demo_script()
                          : request.script_name == "practice" ? device::practice_script()
                                                              : device::load_script(request.script_name);
  if (request.force_scale) script.force_scale = *request.force_scale;
  return script;
}

const case_::Plan& plan_of(const case_::Case& c) {
  if (!c.plan)
    throw Error(ErrorKind::conflict, "case '" + c.id + "' has no plan; make one with `ream plan " + c.id +
                                         " --axis X,Y,Z,DX,DY,DZ`");
  return *c.plan;
}

RigParts asked_for(const RunRequest& request, const fs::path& data) {
  RigParts parts;
  parts.request = request;
  parts.script = find_script(request);
  settle_for_device(request.device, request.device_profile, parts.script);
  parts.bone_case = find_case(request.case_name, data);
  const case_::Plan& plan = plan_of(parts.bone_case);
  parts.case_hash = case_::case_hash(parts.bone_case);
  parts.reamer = reamer_asked_for(reamer_in_library(request.tool.empty() ? plan.reamer : request.tool, data),
                                  request.tool_axis);
  parts.tool = shell::make_tool(parts.reamer.words, parts.reamer.axis);
  MadeDevice made = make_device({request.device, request.device_profile, &parts.script,
                                 sim::world_from_plan(plan), request.random_seed, data});
  parts.device = std::move(made.device);
  parts.link = std::move(made.link);
  parts.settings = settings_for(request, parts.script, parts.device->traits());
  parts.anatomy = find_anatomy(parts.bone_case, request.case_name, data);
  parts.native = measured_glenoid(parts.bone_case, parts.anatomy, parts.tool);
  return parts;
}

Rig::Rig(RigParts parts)
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

nlohmann::json Rig::description() const {
  nlohmann::json description = {
      {"build", version_text()},
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
      {"model", force::to_text(model.settings.feed.kind)},
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
  if (const uint64_t hash = model.feed->table_hash(); hash != 0)
    description["feed_table_hash"] = to_hex(hash);
  return description;
}

}  // namespace ream::app
