#include "app/headless_run.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/interrupt.hpp"
#include "app/session_files.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "sim/haptic_loop.hpp"

namespace ream::app {
namespace {

constexpr size_t report_ring_ticks = 16384;
/// A first touch or two is always a little soft; longer than this is worth a word.
constexpr double told_weakened_s = 2.0;

/// False when there was nothing to take.
bool drain(SpscRing<record::TickReport>& reports, SessionFiles& files) {
  record::TickReport report;
  bool any = false;
  while (reports.try_pop(report)) {
    files.add(report);
    any = true;
  }
  return any;
}

}  // namespace

HeadlessResult run_headless(Rig& rig, const std::filesystem::path& folder, bool wall_clock) {
  SpscRing<record::TickReport> reports(report_ring_ticks);
  SessionFiles files(rig, folder);
  const auto realtime = wall_clock ? sim::Realtime::attempt : sim::Realtime::off;
  sim::HapticLoop loop(rig.model, rig.state, *rig.device, reports, {wall_clock, realtime});
  loop.start();
  while (!loop.ended()) {
    throw_if_interrupted();
    if (!drain(reports, files)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  loop.stop();
  drain(reports, files);

  const sim::LoopHealth health = loop.health();
  if (const std::string fault = to_words(health.end); !fault.empty()) {
    loop.black_box().write("ream-black-box.csv");
    throw Error(ErrorKind::unavailable, fault + " The last seconds are in ream-black-box.csv.");
  }
  if (health.failed_over_tick >= 0) log::warn(sim::failover_words(health.failed_over_tick));
  const SessionFiles::Results results = files.finish(health, nlohmann::json::object());
  if (const double weakened_s = results.metrics.at("weakened_time_s").get<double>();
      weakened_s > told_weakened_s)
    log::warn("the hand felt less than it asked for during " + std::to_string(weakened_s) + " s, as " +
              rig.device->traits().profile + " renders no more; a larger force_scale helps");
  return {results.metrics, results.timing};
}

}  // namespace ream::app
