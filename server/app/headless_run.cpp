#include "app/headless_run.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/interrupt.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "record/recorder.hpp"
#include "record/trace_csv.hpp"
#include "score/metrics.hpp"
#include "sim/haptic_loop.hpp"

namespace ream::app {
namespace {

constexpr size_t report_ring_ticks = 16384;

/// Takes the loop's reports as they come and keeps trace, recording and metrics.
class Followers {
 public:
  Followers(Rig& rig, const std::filesystem::path& folder)
      : trace_(folder / "trace.csv", rig.bone_case.bone.grid.voxel_volume_mm3()),
        recorder_(folder / "recording.ream", rig.description()),
        metrics_(rig.bone_case.bone.grid.voxel_volume_mm3(), rig.model.world_from_plan.inverse()) {}

  /// False when there was nothing to take.
  bool drain(SpscRing<record::TickReport>& reports) {
    record::TickReport report;
    bool any = false;
    while (reports.try_pop(report)) {
      trace_.add(report);
      recorder_.add(report);
      metrics_.add(report);
      any = true;
    }
    return any;
  }

  score::Metrics finish() {
    trace_.finish();
    recorder_.finish();
    return metrics_.metrics();
  }

 private:
  record::TraceCsv trace_;
  record::Recorder recorder_;
  score::MetricsAccumulator metrics_;
};

nlohmann::json timing_json(const sim::LoopHealth& health) {
  const TimingSummary& t = health.tick_us;
  return {{"tick_us", {{"mean", t.mean_us}, {"p50", t.p50_us}, {"p99", t.p99_us}, {"p999", t.p999_us}, {"max", t.max_us}}},
          {"missed", health.missed},
          {"ticks", t.count}};
}

void write_json(const std::filesystem::path& path, const nlohmann::json& json) {
  write_file_atomically(path, json.dump(2) + "\n");
}

}  // namespace

HeadlessResult run_headless(Rig& rig, const std::filesystem::path& folder, bool wall_clock) {
  SpscRing<record::TickReport> reports(report_ring_ticks);
  Followers followers(rig, folder);
  const auto realtime = wall_clock ? sim::Realtime::attempt : sim::Realtime::off;
  sim::HapticLoop loop(rig.model, rig.state, *rig.device, reports, {wall_clock, realtime});
  loop.start();
  while (!loop.ended()) {
    throw_if_interrupted();
    if (!followers.drain(reports)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  loop.stop();
  followers.drain(reports);

  const sim::LoopHealth health = loop.health();
  if (const std::string fault = to_words(health.end); !fault.empty()) {
    loop.black_box().write("ream-black-box.csv");
    throw Error(ErrorKind::unavailable, fault + " The last seconds are in ream-black-box.csv.");
  }
  const uint64_t grid_hash = rig.bone_case.bone.coverage_hash();
  HeadlessResult result{score::metrics_json(followers.finish(), rig.model.settings.force_scale, &grid_hash),
                        timing_json(health)};
  write_json(folder / "metrics.json", result.metrics);
  write_json(folder / "timing.json", result.timing);
  write_json(folder / "session.json", rig.description());
  return result;
}

}  // namespace ream::app
