#include "session/simulation/session_setup.hpp"

#include "core/units.hpp"
#include "device/registry/device_registry.hpp"
#include "net/problem.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/simulation.hpp"
#include "sim/settings.hpp"

namespace ream::session {
namespace {

force::VibrationSettings vibration_settings(const device::ScriptVibration& script) {
  force::VibrationSettings settings;
  settings.source = force::vibration_source_from(script.source);
  settings.recordings = {script.cortical_file, script.cancellous_file, script.idle_file, script.rate_hz};
  return settings;
}

sim::Settings settings_for(const RunRequest& request, const device::Script& script,
                           const case_::Case& bone_case, const device::DeviceTraits& traits) {
  sim::Settings settings;
  settings.backend = request.backend;
  settings.removal = request.removal;
  settings.tool_spacing_mm = request.tool_spacing_mm;
  settings.force_scale = script.force_scale;
  settings.vibration = vibration_settings(script.vibration);
  sim::fit_to_device(traits, script.stiffness_n_mm, settings);
  if (script.vibration.n_per_g) settings.vibration.vibration_n_per_g = *script.vibration.n_per_g;
  settings.mount = script.mount;
  settings.random_seed = request.random_seed;
  settings.feed.kind =
      force::feed_kind_from_text(request.feed_model.empty() ? script.feed_model : request.feed_model);
  settings.feed.plugin = force::offered_feed_model();
  settings.feed.spindle_rad_s = rad_s_from_rpm(script.spindle_rpm);
  settings.feed.specimen_factor = script.specimen_factor;
  // A study's script says what it compares; else bone is cut as its case says.
  settings.feed.cutting = script.cutting.value_or(bone_case.cutting.value_or(force::CuttingCoefficients{}));
  settings.spindle = script.drive;
  return settings;
}

}  // namespace

device::Script find_script(const RunRequest& request) {
  device::Script script = request.script                      ? *request.script
                          : request.script_name == "demo"     ? device::demo_script()
                          : request.script_name == "practice" ? device::practice_script()
                                                              : device::load_script(request.script_name);
  if (request.at_most_scripts_scale && request.force_scale && *request.force_scale > script.force_scale)
    throw net::RequestError(403, "force_scale is above the script's own, " +
                                     std::to_string(script.force_scale) +
                                     "; only instructors and operators may choose more");
  if (request.force_scale) script.force_scale = *request.force_scale;
  return script;
}

SimulationSetup build_setup(const RunRequest& request, const std::filesystem::path& data) {
  SimulationSetup parts;
  parts.request = request;
  parts.script = find_script(request);
  device::settle_for_device(request.device, request.device_profile, parts.script);
  parts.bone_case = find_case(request.case_name, data);
  const case_::Plan& plan = plan_of(parts.bone_case);
  parts.case_hash = case_::case_hash(parts.bone_case);
  parts.reamer = reamer_asked_for(reamer_in_library(request.tool.empty() ? plan.reamer : request.tool, data),
                                  request.tool_axis);
  parts.tool = shell::make_tool(parts.reamer.words, parts.reamer.axis);
  device::MadeDevice made = device::make_device({request.device, request.device_profile, &parts.script,
                                                 sim::world_from_plan(plan), request.random_seed, data});
  parts.device = std::move(made.device);
  parts.link = std::move(made.link);
  parts.settings = settings_for(request, parts.script, parts.bone_case, parts.device->traits());
  parts.anatomy = find_anatomy(parts.bone_case, request.case_name, data);
  parts.native = measured_glenoid(parts.bone_case, parts.anatomy, parts.tool);
  return parts;
}

std::shared_ptr<const score::NativeGlenoid> measured_glenoid(const case_::Case& native,
                                                             const case_::Anatomy& anatomy,
                                                             const shell::Tool& reamer) {
  return std::make_shared<const score::NativeGlenoid>(score::Task{anatomy, native.plan, reamer.profile},
                                                      native.bone);
}

}  // namespace ream::session
