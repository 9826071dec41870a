#include <memory>
#include <thread>

#include "bench/collide_parts.hpp"
#include "bench/seated_reaming.hpp"
#include "sim/haptic_loop.hpp"

namespace ream::bench {
namespace {

constexpr double thesis_tick_us = 314.89;  ///< thesis 5.4.2, on a GTX 970
constexpr double mean_goal_us = 1000.0, p50_goal_us = 300.0, p99_goal_us = 500.0;
constexpr size_t ring_bricks = 4096;

struct Measured {
  sim::LoopHealth health;
  double engaged_points = 0.0, removed_mm3 = 0.0, brick_images = 0.0;
  std::string backend;
};

Measured measure(const case_::Case& bone_case, const std::string& backend) {
  case_::Case copy = bone_case;
  const device::Script script = seated_script();
  const sim::Model model = sim::make_model(*copy.plan, copy.bone, shell::make_tool(shell::thesis_tool),
                                           seated_settings(script, backend));
  sim::State state(model, copy.bone);
  voxel::BrickRing bricks(ring_bricks);
  voxel::BrickSender sender(copy.bone.grid, bricks);
  state.brick_sender = &sender;
  const auto device = device::make_scripted_device(script, model.world_from_plan);
  SpscRing<record::TickReport> reports(1u << 13);
  sim::HapticLoop loop(model, state, *device, reports, {false, sim::Realtime::off});
  loop.start();
  Measured m;
  m.backend = state.backend.name;
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

}  // namespace

std::vector<Row> tick_rows(const case_::Case& bone_case) {
  std::vector<Row> rows;
  for (const std::string backend : {"cpu", "opencl"}) {
    const Measured m = measure(bone_case, backend);
    const TimingSummary& t = m.health.tick_us;
    const std::string name = "thesis-5-4-2 seated reaming, removal and bricks, tick, " + m.backend;
    rows.push_back({"collide", name + ", mean", t.mean_us, thesis_tick_us, "us", mean_goal_us});
    rows.push_back({"collide", name + ", p50", t.p50_us, 0.0, "us", backend == "cpu" ? p50_goal_us : 0.0});
    rows.push_back({"collide", name + ", p99", t.p99_us, 0.0, "us", backend == "cpu" ? p99_goal_us : 0.0});
    rows.push_back({"collide", name + ", max", t.max_us, 0.0, "us", 0.0});
    rows.push_back({"collide", name + ", engaged points", m.engaged_points, 0.0, "points", 0.0});
    rows.push_back({"collide", name + ", removed", m.removed_mm3, 0.0, "mm3", 0.0});
    rows.push_back({"collide", name + ", brick images sent", m.brick_images, 0.0, "bricks", 0.0});
  }
  return rows;
}

}  // namespace ream::bench
