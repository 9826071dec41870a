#include <filesystem>
#include <memory>
#include <thread>

#include "bench/bench.hpp"
#include "bench/seated_reaming.hpp"
#include "bench/seek_rows.hpp"
#include "core/clock.hpp"
#include "ct/phantom/phantom_case.hpp"
#include "record/recorder.hpp"
#include "sim/haptic_loop.hpp"

namespace ream::bench {
namespace {

constexpr double megabyte = 1e6;
constexpr int turns = 12;
constexpr double megabytes_a_minute_goal = 30.0, core_share_goal_percent = 5.0, more_misses_goal_points = 0.1;

/// What a follower does with the loop's rings; none: it drops what it takes.
struct Follower {
  record::Recorder* recorder = nullptr;
  voxel::BrickRing bricks{8192};
  SpscRing<record::TickReport> reports{16384};
  uint32_t engaged_ticks = 0;

  void take() {
    std::vector<record::TickReport> taken;
    record::TickReport report;
    while (reports.try_pop(report)) taken.push_back(report);
    voxel::BrickImage image;
    while (bricks.try_pop(image))
      if (recorder != nullptr) recorder->add(image);
    for (const record::TickReport& one : taken) {
      engaged_ticks += one.engaged;
      if (recorder != nullptr) recorder->add(one);
    }
  }
};

struct Measured {
  double missed_percent = 0.0, tick_p99_us = 0.0;
  double recorder_cpu_percent = 0.0, megabytes_a_minute = 0.0, engaged_percent = 0.0;

  /// Towards the mean of so many.
  void add_share(const Measured& one, int of) {
    for (double Measured::*field :
         {&Measured::missed_percent, &Measured::tick_p99_us, &Measured::recorder_cpu_percent,
          &Measured::megabytes_a_minute, &Measured::engaged_percent})
      this->*field += one.*field / of;
  }
};

/// A minute of it: press, lift, press again, as a hand does that looks now and then.
device::Script pecking_script(double press_n) {
  device::Script script = seated_script();
  script.duration_s = 60.0;
  script.hand.force_profile = {{0.0, 10.0}, {0.5, press_n}};
  for (double t = 6.0; t < 60.0; t += 6.0) {
    for (const device::TimedForce& f : {device::TimedForce{t - 0.4, press_n},
                                        {t - 0.3, -8.0},
                                        {t - 0.1, -8.0},
                                        {t, 10.0},
                                        {t + 0.3, press_n}})
      script.hand.force_profile.push_back(f);
  }
  return script;
}

Measured measure(const case_::Case& bone_case, const device::Script& script, bool recorded,
                 const std::filesystem::path& folder) {
  case_::Case copy = bone_case;
  const sim::Model model = sim::make_model(*copy.plan, copy.bone, shell::make_tool(shell::thesis_tool),
                                           seated_settings(script, "cpu"));
  const std::vector<uint8_t> start = copy.bone.coverage;
  sim::State state(model, copy.bone);
  Follower follower;
  voxel::BrickSender sender(copy.bone.grid, follower.bricks);
  state.brick_sender = &sender;
  std::unique_ptr<record::Recorder> recorder;
  const std::filesystem::path file = folder / "recording.ream";
  std::filesystem::remove(file);
  if (recorded) {
    record::ops::Header header;
    header.start_grid_hash = copy.bone.coverage_hash();
    recorder = std::make_unique<record::Recorder>(record::create_log_file(file), header,
                                                  record::ops::Segment{}, start.data());
    follower.recorder = recorder.get();
  }
  const auto device = device::make_scripted_device(script, model.world_from_plan);
  sim::HapticLoop loop(model, state, *device, follower.reports, {true, sim::Realtime::attempt});
  loop.start();
  while (!loop.ended()) {
    follower.take();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  loop.stop();
  follower.take();
  const sim::LoopHealth health = loop.health();
  Measured m;
  const double seconds = static_cast<double>(state.tick) * tick_s;
  m.missed_percent = 100.0 * static_cast<double>(health.missed) / static_cast<double>(state.tick);
  m.tick_p99_us = health.tick_us.p99_us;
  m.engaged_percent = 100.0 * follower.engaged_ticks / static_cast<double>(state.tick);
  if (recorder == nullptr) return m;
  recorder->finish("finished");
  m.recorder_cpu_percent = 100.0 * recorder->cpu_s() / seconds;
  m.megabytes_a_minute = static_cast<double>(recorder->bytes_written()) / megabyte * 60.0 / seconds;
  return m;
}

void add_rows(const std::string& what, const Measured& with, const Measured& without,
              std::vector<Row>& rows) {
  const std::string name = "thesis-5-4-2, " + what + ", ";
  rows.push_back({"record", name + "ticks in contact", with.engaged_percent, 0.0, "%", 0.0});
  rows.push_back(
      {"record", name + "recording a minute", with.megabytes_a_minute, 0.0, "MB", megabytes_a_minute_goal});
  rows.push_back(
      {"record", name + "recorder's thread", with.recorder_cpu_percent, 0.0, "%", core_share_goal_percent});
  rows.push_back({"record", name + "tick p99 with and (baseline) without", with.tick_p99_us,
                  without.tick_p99_us, "us", 0.0});
  rows.push_back({"record", name + "ticks missed with and (baseline) without", with.missed_percent,
                  without.missed_percent, "%", without.missed_percent + more_misses_goal_points});
}

}  // namespace

std::vector<Row> record_suite(const Options&) {
  const ct::PhantomPreset preset = ct::phantom_preset("thesis-5-4-2");
  const case_::Case bone_case = ct::make_phantom_case("thesis-5-4-2", preset.params, preset.upsample);
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "ream-bench-record";
  std::filesystem::create_directories(folder);
  std::vector<Row> rows;
  const device::Script pecking = pecking_script(20.0), pressing = seated_script();
  const Measured without = measure(bone_case, pecking, false, folder);
  add_rows("a minute of pecking at 20 N", measure(bone_case, pecking, true, folder), without, rows);
  // Six seconds are few ticks to count misses in, so the two take turns.
  Measured pressed, recorded;
  for (int turn = 0; turn < turns; ++turn) {
    pressed.add_share(measure(bone_case, pressing, false, folder), turns);
    recorded.add_share(measure(bone_case, pressing, true, folder), turns);
  }
  add_rows("six seconds pressed at 52 N", recorded, pressed, rows);
  add_seek_rows(bone_case, folder, rows);
  std::filesystem::remove_all(folder);
  return rows;
}

}  // namespace ream::bench
