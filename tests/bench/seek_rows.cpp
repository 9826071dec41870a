#include "bench/seek_rows.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <random>
#include <thread>

#include "bench/seated_reaming.hpp"
#include "core/clock.hpp"
#include "record/recorder.hpp"
#include "session/replay/replay_picture.hpp"
#include "session/simulation/session_setup.hpp"
#include "sim/step.hpp"
#include "stream/fanout.hpp"

namespace ream::bench {
namespace {

constexpr double moment_goal_ms = 300.0;
constexpr uint32_t hour_ticks = 3'600'000, simulated_ticks = 30'000;
constexpr uint32_t stretch = hour_ticks / simulated_ticks;
constexpr int moments = 50;
constexpr unsigned seek_seed = 11;
constexpr size_t max_waiting_chunks = 16;

/// What half a minute of reaming did: every tick's report, and of every chunk the bricks that it changed.
struct Reaming {
  std::vector<record::TickReport> reports;
  std::vector<std::vector<voxel::BrickImage>> changed;
};

Reaming ream_at_full_thrust(const case_::Case& bone_case) {
  case_::Case copy = bone_case;
  device::Script script = seated_script();
  script.duration_s = simulated_ticks * tick_s;
  const sim::Model model = sim::make_model(*copy.plan, copy.bone, shell::make_tool(shell::thesis_tool),
                                           seated_settings(script, "cpu"));
  sim::State state(model, copy.bone);
  voxel::BrickRing ring(1 << 16);
  voxel::BrickSender sender(copy.bone.grid, ring);
  state.brick_sender = &sender;
  const auto device = device::make_scripted_device(script, model.world_from_plan);
  device->open();
  Reaming reaming;
  std::unordered_map<uint32_t, voxel::BrickImage> newest;
  device::DeviceInput input;
  while (device->read(input) == device::DeviceStatus::ok) {
    record::TickReport report;
    if (sim::step(model, state, input, report) != sim::StepStatus::ok) break;
    device->write(sim::output_of(report));
    reaming.reports.push_back(report);
    voxel::BrickImage image;
    while (ring.try_pop(image)) newest[image.brick] = image;
    if (reaming.reports.size() % record::ticks_per_chunk != 0) continue;
    auto& images = reaming.changed.emplace_back();
    for (const auto& [brick, last] : newest) images.push_back(last);
    newest.clear();
  }
  return reaming;
}

/// The same reaming, `stretch` times slower: its reports over and over, its bricks one after the other.
void write_hour(const Reaming& reaming, const voxel::BoneModel& bone, const std::filesystem::path& file) {
  std::filesystem::remove(file);
  record::ops::Header header;
  header.start_grid_hash = bone.coverage_hash();
  record::ops::Segment segment;
  segment.tool = shell::thesis_tool;
  record::Recorder recorder(record::create_log_file(file), header, segment, bone.coverage.data());
  for (uint32_t tick = 0; tick < hour_ticks; ++tick) {
    if (tick % record::ticks_per_chunk == 0) {
      const uint32_t chunk = tick / record::ticks_per_chunk, part = chunk % stretch;
      const auto& images = reaming.changed.at(chunk / stretch);
      for (size_t i = images.size() * part / stretch; i < images.size() * (part + 1) / stretch; ++i) {
        voxel::BrickImage image = images[i];
        image.tick = tick;
        recorder.add(image);
      }
      while (recorder.waiting_chunks() > max_waiting_chunks)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    record::TickReport report = reaming.reports[tick % reaming.reports.size()];
    report.tick = tick;
    recorder.add(report);
  }
  recorder.finish("finished");
}

double value_at_share(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<size_t>(share * static_cast<double>(values.size() - 1))];
}

void add_rows(const std::string& what, const std::vector<double>& ms, std::vector<Row>& rows) {
  const std::string name = "seek, an hour of thesis-5-4-2, " + what;
  rows.push_back({"record", name + ", median", value_at_share(ms, 0.5), 0.0, "ms", 0.0});
  rows.push_back({"record", name + ", slowest of 50", value_at_share(ms, 1.0), 0.0, "ms", moment_goal_ms});
}

}  // namespace

void add_seek_rows(const case_::Case& bone_case, const std::filesystem::path& folder,
                   std::vector<Row>& rows) {
  case_::Case before = bone_case;
  const auto native = session::measured_glenoid(before, {before.side, std::nullopt, before.glenoid},
                                                shell::make_tool(before.plan->reamer));
  case_::cut_pilot_hole(before.bone, *before.plan);
  const std::filesystem::path file = folder / "hour.ream";
  write_hour(ream_at_full_thrust(bone_case), before.bone, file);

  const auto opening = SteadyClock::now();
  const record::Recording recording(file);
  rows.push_back({"record", "seek, an hour of thesis-5-4-2, opening the file", elapsed_us(opening) * 1e-3,
                  0.0, "ms", 0.0});
  rows.push_back({"record", "seek, an hour of thesis-5-4-2, size of the file",
                  static_cast<double>(std::filesystem::file_size(file)) * 1e-6, 0.0, "MB", 0.0});

  std::mt19937 random(seek_seed);
  std::uniform_int_distribution<uint32_t> any_moment(0, recording.tick_count());
  std::vector<double> bone_ms, viewer_ms;
  record::RecordedBone bone(recording, before.bone.grid, before.bone.coverage);
  for (int i = 0; i < moments; ++i) {
    const auto start = SteadyClock::now();
    bone.seek(any_moment(random), [](const voxel::BrickImage&) {});
    bone_ms.push_back(elapsed_us(start) * 1e-3);
  }
  add_rows("the bone alone", bone_ms, rows);

  stream::Fanout fanout;
  const session::MetricsTimeline timeline(
      recording, before.bone.grid.world_from_grid,
      {before.bone.grid.voxel_volume_mm3(), sim::world_from_plan(*before.plan).inverse()});
  timeline.wait_for(recording.tick_count(), std::chrono::minutes(10));
  session::ReplayPicture picture(recording, before, native, timeline, stream::HelloInfo{}, fanout);
  const auto viewer = fanout.subscribe({}, 1);
  while (viewer->next()) {
  }
  for (uint32_t i = 0; i < moments; ++i) {
    const auto start = SteadyClock::now();
    picture.show({any_moment(random), i + 1, 1.0f, false, {}});
    while (viewer->next()) {
    }
    viewer_ms.push_back(elapsed_us(start) * 1e-3);
  }
  add_rows("until surface and trace are with a viewer", viewer_ms, rows);
}

}  // namespace ream::bench
