#include <chrono>
#include <string>
#include <thread>
#include <utility>

#include "bench/collide_parts.hpp"
#include "bench/timed_backend.hpp"
#include "ct/phantom/phantom_case.hpp"
#include "device/script/script.hpp"
#include "device/simulated/scripted_device.hpp"
#include "sim/haptic_loop.hpp"

namespace ream::bench {
namespace {

/// Thesis 5.4.2, on a GTX 970: ticks of a user who reams, on a bone of this size.
constexpr double thesis_tick_us = 314.89;
constexpr double mean_goal_us = 1000.0, p50_goal_us = 300.0, p99_goal_us = 500.0;
constexpr size_t ring_bricks = 4096;

/// The demo's script from approach to withdrawal, ticks in air among them. Of a session it lacks the guard of
/// energy, which has no part in contact.
struct Scene {
  std::string name;
  const case_::Case& bone_case;
  double spacing_mm;
  bool is_thesis_case;
};

struct Measured {
  sim::LoopHealth health;
  double engaged_points = 0.0, removed_mm3 = 0.0, brick_images = 0.0;
  std::string backend;
  StageTimes stages;
};

sim::Settings settings_of(const Scene& scene, const device::Script& script, const std::string& backend) {
  sim::Settings settings;
  settings.backend = backend;
  settings.tool_spacing_mm = scene.spacing_mm;
  settings.stiffness_n_mm = script.stiffness_n_mm;
  settings.angular_stiffness_n_mm_rad = 1000.0 * script.stiffness_n_mm;
  settings.energy_guarded = false;
  return settings;
}

Measured measure(const Scene& scene, const std::string& backend) {
  case_::Case copy = scene.bone_case;
  const device::Script script = device::demo_script();
  const sim::Model model = sim::make_model(*copy.plan, copy.bone, shell::make_tool(copy.plan->reamer),
                                           settings_of(scene, script, backend));
  sim::State state(model, copy.bone);
  Measured m;
  m.backend = state.backend.name;
  time_stages(state.backend, m.stages);
  voxel::BrickRing bricks(ring_bricks);
  voxel::BrickSender sender(copy.bone.grid, bricks);
  state.brick_sender = &sender;
  const auto device = device::make_scripted_device(script, model.world_from_plan);
  SpscRing<record::TickReport> reports(1u << 13);
  sim::HapticLoop loop(model, state, *device, reports, {false, sim::Realtime::off});
  loop.start();
  int64_t engaged_ticks = 0;
  record::TickReport report;
  voxel::BrickImage image;
  const auto take = [&] {
    while (bricks.try_pop(image)) ++m.brick_images;
    while (reports.try_pop(report)) {
      engaged_ticks += report.engaged;
      m.engaged_points += static_cast<double>(report.engaged_points);
      for (const int64_t levels : report.coverage_removed)
        m.removed_mm3 += static_cast<double>(levels) / 255.0 * copy.bone.grid.voxel_volume_mm3();
    }
  };
  while (!loop.ended()) {
    take();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  loop.stop();
  take();
  m.health = loop.health();
  if (engaged_ticks > 0) m.engaged_points /= static_cast<double>(engaged_ticks);
  return m;
}

/// Table 4.2's question: where the time of a tick goes. Its cells cannot be read in the thesis' text.
void add_stages(std::vector<Row>& rows, const std::string& name, const Measured& m) {
  const double ticks = static_cast<double>(m.health.tick_us.count);
  double stages_us = 0.0;
  for (const auto& [stage, histogram] :
       {std::pair("contact", &m.stages.contact), std::pair("removal", &m.stages.removal)}) {
    const TimingSummary t = histogram->summary();
    const double mean_us = ticks > 0.0 ? t.mean_us * static_cast<double>(t.count) / ticks : 0.0;
    stages_us += mean_us;
    const std::string which = name + ", of which " + stage;
    rows.push_back({"collide", which + ", mean of all ticks", mean_us, 0.0, "us", 0.0});
    rows.push_back({"collide", which + ", one call, p50", t.p50_us, 0.0, "us", 0.0});
    rows.push_back({"collide", which + ", one call, p99", t.p99_us, 0.0, "us", 0.0});
  }
  rows.push_back({"collide", name + ", of which all else (device, forces, heat, bricks), mean of all ticks",
                  m.health.tick_us.mean_us - stages_us, 0.0, "us", 0.0});
}

}  // namespace

std::vector<Row> tick_rows(const case_::Case& thesis_case) {
  const ct::PhantomPreset preset = ct::phantom_preset("demo");
  case_::Case demo = ct::make_phantom_case("demo", preset.params, preset.upsample);
  demo.plan->depth_mm = 1.0;
  const Scene scenes[] = {{"whole demo, points 0.2 mm apart", demo, 0.2, false},
                          {"whole demo, points 0.1 mm apart", demo, 0.1, false},
                          {"whole demo on thesis-5-4-2, points 0.1 mm apart", thesis_case, 0.1, true}};
  std::vector<Row> rows;
  for (const Scene& scene : scenes)
    for (const std::string backend : {"cpu", "opencl"}) {
      const Measured m = measure(scene, backend);
      const TimingSummary& t = m.health.tick_us;
      const bool judged = backend == "cpu";
      const std::string name = scene.name + ", tick, " + m.backend;
      rows.push_back({"collide", name + ", mean", t.mean_us, scene.is_thesis_case ? thesis_tick_us : 0.0,
                      "us", mean_goal_us});
      rows.push_back({"collide", name + ", p50", t.p50_us, 0.0, "us", judged ? p50_goal_us : 0.0});
      rows.push_back({"collide", name + ", p99", t.p99_us, 0.0, "us", judged ? p99_goal_us : 0.0});
      rows.push_back({"collide", name + ", max", t.max_us, 0.0, "us", 0.0});
      rows.push_back({"collide", name + ", engaged points", m.engaged_points, 0.0, "points", 0.0});
      rows.push_back({"collide", name + ", removed", m.removed_mm3, 0.0, "mm3", 0.0});
      rows.push_back({"collide", name + ", brick images sent", m.brick_images, 0.0, "bricks", 0.0});
      add_stages(rows, name, m);
    }
  return rows;
}

}  // namespace ream::bench
