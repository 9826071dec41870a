#pragma once
#include <vector>

#include "core/units.hpp"
#include "device/profiles.hpp"
#include "device/simulated/scripted_device.hpp"
#include "sim/settings.hpp"
#include "sim/step.hpp"
#include "support/test_bone.hpp"

namespace ream::test {

/// Everything a short run needs, kept together because the model refers to the bone.
struct SmallRun {
  SmallRun(voxel::BoneModel bone_in, const case_::Plan& plan, const std::string& tool,
           const device::Script& script, const std::string& backend = "cpu",
           sim::RemovalLaw removal = sim::RemovalLaw::profile,
           force::FeedKind feed_kind = force::FeedKind::empirical)
      : SmallRun(std::move(bone_in), plan, tool, script, settings(script, backend, removal, feed_kind)) {}

  SmallRun(voxel::BoneModel bone_in, const case_::Plan& plan, const std::string& tool,
           const device::Script& script, const sim::Settings& settings)
      : bone(std::move(bone_in)),
        model(sim::make_model(plan, bone, shell::make_tool(tool), settings)),
        state(model, bone),
        device(device::make_scripted_device(script, model.world_from_plan)) {}

  static sim::Settings settings(const device::Script& script, const std::string& backend,
                                sim::RemovalLaw removal = sim::RemovalLaw::profile,
                                force::FeedKind feed_kind = force::FeedKind::empirical) {
    sim::Settings s;
    s.backend = backend;
    s.removal = removal;
    s.tool_spacing_mm = 0.25;
    s.force_scale = script.force_scale;
    s.vibration.source = force::VibrationSource::off;  // making it takes a while
    sim::fit_to_device(device::device_profile(script.device_profile), script.stiffness_n_mm, s);
    s.limits = {};  // what the simulation wants to render, not what a device makes of it
    s.feed.kind = feed_kind;
    s.feed.spindle_rad_s = rad_s_from_rpm(script.spindle_rpm);
    s.feed.specimen_factor = script.specimen_factor;
    s.mount = script.mount;
    return s;
  }

  /// One report per tick until the script ends.
  std::vector<record::TickReport> run() {
    std::vector<record::TickReport> reports;
    device->open();
    device::DeviceInput input;
    while (device->read(input) == device::DeviceStatus::ok) {
      record::TickReport report;
      if (sim::step(model, state, input, report) != sim::StepStatus::ok) break;
      device->write(sim::output_of(report));
      reports.push_back(report);
    }
    return reports;
  }

  voxel::BoneModel bone;
  sim::Model model;
  sim::State state;
  std::unique_ptr<device::HapticDevice> device;
};

/// A hand that leans on the bone with a constant simulated force from the first contact on.
inline device::Script steady_push(double force_n, double duration_s, double force_scale = 1.0) {
  device::Script script;
  script.duration_s = duration_s;
  script.force_scale = force_scale;
  script.stiffness_n_mm = 100.0 / force_scale;
  script.hand.start_mm = Vec3(0, 0, -0.6);
  script.hand.force_profile = {{0.0, force_n}};
  return script;
}

}  // namespace ream::test
