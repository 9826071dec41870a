#include "session/live/headless_run.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/log.hpp"
#include "device/crash_guard.hpp"
#include "session/live/loop_rings.hpp"
#include "sim/haptic_loop.hpp"

namespace ream::session {
namespace {

/// A first touch or two is always a little soft; longer than this is worth a word.
constexpr double min_reported_weakened_s = 2.0;
/// Between plate and cancellous bone every reaming passes such densities for a moment.
constexpr double min_reported_guessed_s = 2.0;

/// Nobody's tick is late in virtual time, so the recording may have every changed brick at once.
constexpr int bricks_a_tick_without_hurry = 8192;
/// Chunks that may wait for the disk before a run in virtual time waits for it.
constexpr size_t enough_waiting_chunks = 16;

constexpr uint32_t ticks_between_progress = 100;

/// A loop that stands still for longer than this will not come back.
constexpr int64_t max_standstill_ms = 5000;

/// Its densities are those that it was made with.
bool is_phantom(const case_::Case& c) { return c.source.starts_with("phantom"); }

[[noreturn]] void throw_fault(const sim::BlackBox& box, sim::LoopEnd end) {
  box.write("ream-black-box.csv");
  throw Error(ErrorKind::unavailable, message_of(end) + " The last seconds are in ream-black-box.csv.");
}

}  // namespace

SessionFiles::Results run_headless(Simulation& simulation, std::span<const uint8_t> start_coverage,
                                   const std::filesystem::path& folder, bool wall_clock,
                                   const Progress& progress) {
  LoopRings rings(simulation.bone_case.bone.grid);
  simulation.state.brick_sender = &rings.sender;
  if (!wall_clock) simulation.state.brick_budget = bricks_a_tick_without_hurry;
  const auto realtime = wall_clock ? sim::Realtime::attempt : sim::Realtime::off;
  sim::HapticLoop loop(simulation.model, simulation.state, *simulation.device, rings.reports,
                       {wall_clock, realtime});
  // After the loop: where that stands still to the end of the process, they have been closed before.
  SessionFiles files(simulation, folder, start_coverage.data(), SessionFiles::Trace::written);
  sim::BlackBox recent;
  const auto take_brick = [&](const voxel::BrickImage& image) { files.add(image); };
  const double all_ticks = std::max(simulation.script.duration_s / tick_s, 1.0);
  const auto take_report = [&](const record::TickReport& report) {
    if (report.tick % ticks_between_progress == 0)
      progress(std::min(report.tick / all_ticks, 1.0), "reaming");
    recent.remember(report);
    files.add(report);
    for (const record::ops::Event& event : files.newest_events())
      log::warn("at " + std::to_string(event.tick) + " ms: " + event.words);
  };
  const device::CrashWatch crash_watch(*simulation.device);
  loop.start();
  while (!loop.ended()) {
    throw_if_interrupted();
    if (loop.stood_still_ms() > max_standstill_ms) throw_fault(recent, sim::LoopEnd::stood_still);
    const bool late = files.recorder().waiting_chunks() > enough_waiting_chunks;
    if (late || !rings.drain(take_brick, take_report))
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  loop.stop();
  simulation.state.brick_sender = nullptr;
  rings.drain_rest(simulation.bone_case.bone, simulation.state.tick - 1, take_brick, take_report);

  const sim::LoopHealth health = loop.health();
  if (!message_of(health.end).empty()) throw_fault(loop.black_box(), health.end);
  if (health.failed_over_tick >= 0) log::warn(sim::failover_message(health.failed_over_tick));
  SessionFiles::Results results = files.finish(health);
  if (const double weakened_s = results.metrics.at("weakened_time_s").get<double>();
      weakened_s > min_reported_weakened_s)
    log::warn("the hand felt less than it asked for during " + std::to_string(weakened_s) + " s, as " +
              simulation.device->traits().profile + " renders no more; a larger force_scale helps");
  const double guessed_s = results.metrics.at("extrapolated_time_s").get<double>();
  if (guessed_s > min_reported_guessed_s)
    log::warn(
        "feed is extrapolated during " + std::to_string(guessed_s) +
        " s, as nobody has measured bone of such density; see extrapolated_time_s in docs/reference.md");
  if (simulation.bone_case.calibration.scanner.empty() && !is_phantom(simulation.bone_case))
    log::warn("the densities of case '" + simulation.bone_case.id +
              "' are a guess: its scan was turned into density by an example calibration");
  return results;
}

}  // namespace ream::session
