#include "bench/scored_reaming.hpp"

#include <time.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "bench/pecking.hpp"
#include "core/clock.hpp"
#include "core/data_folder.hpp"
#include "core/file.hpp"
#include "score/live_score.hpp"
#include "session/live/loop_rings.hpp"
#include "session/live/session_files.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/session_setup.hpp"
#include "session/simulation/simulation.hpp"
#include "shell/tool.hpp"
#include "sim/haptic_loop.hpp"

namespace ream::bench {
namespace {

constexpr double scored_press_n = 35.0, shell_spacing_mm = 0.1;
/// Feed of a specimen so hard that ten minutes stay in the vault.
constexpr double hard = 0.1;
/// How often a server looks at what has come.
constexpr uint32_t ticks_a_look = 10;
constexpr int bricks_a_tick = 8192;
constexpr size_t enough_waiting_chunks = 16;

double thread_cpu_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

session::RunRequest request_for(const std::filesystem::path& folder, double duration_s) {
  write_file_atomically(folder / "script.json", pecking(duration_s, scored_press_n, hard).dump());
  session::RunRequest request;
  request.case_name = thesis_case;
  request.script_name = (folder / "script.json").string();
  request.backend = "cpu";
  request.tool_spacing_mm = shell_spacing_mm;
  return request;
}

/// What a server's follower keeps up to date, and what that costs it.
class LiveScoring {
 public:
  LiveScoring(const session::Simulation& simulation, std::vector<uint8_t> start)
      : grid_(simulation.bone_case.bone.grid),
        force_scale_(simulation.model.settings.force_scale),
        left_(std::move(start)),
        ticks_(grid_.voxel_volume_mm3(), simulation.model.world_from_plan.inverse()),
        live_(simulation.native, simulation.model.world_from_plan) {}

  void take(const voxel::BrickImage& image) {
    voxel::write_brick(grid_, left_.data(), image.brick, image.coverage);
  }
  void take(const record::TickReport& report) {
    waiting_.push_back(report);
    if (waiting_.size() == ticks_a_look) look();
  }

  double cpu_s() const { return cpu_s_; }
  double measuring_s() const { return measuring_s_; }
  int measurements() const { return measurements_; }

 private:
  void look() {
    const int64_t now_ns = int64_t{waiting_.back().tick} * 1'000'000;
    const double begun = thread_cpu_s();
    for (const record::TickReport& report : waiting_) ticks_.add(report);
    const double before = thread_cpu_s();
    const bool measured = live_.update(ticks_, {grid_, left_.data()}, now_ns);
    const double after = thread_cpu_s();
    if (now_ns >= json_due_ns_) {
      json_due_ns_ = now_ns + score::LiveScore::publish_period_ns;
      json_ = score::session_metrics_json(ticks_, live_.results(), force_scale_, nullptr);
    }
    cpu_s_ += thread_cpu_s() - begun;
    waiting_.clear();
    if (!measured) return;
    measuring_s_ += after - before;
    ++measurements_;
  }

  const voxel::VoxelGrid grid_;
  const double force_scale_;
  std::vector<uint8_t> left_;
  std::vector<record::TickReport> waiting_;
  score::MetricsAccumulator ticks_;
  score::LiveScore live_;
  nlohmann::json json_;
  int64_t json_due_ns_ = 0;
  double cpu_s_ = 0.0, measuring_s_ = 0.0;
  int measurements_ = 0;
};

double native_ms_of(const std::filesystem::path& data) {
  const case_::Case native = session::find_case(thesis_case, data);
  const case_::Anatomy anatomy = session::find_anatomy(native, thesis_case, data);
  const shell::Tool reamer = shell::make_tool(native.plan->reamer);
  const auto begun = SteadyClock::now();
  session::measured_glenoid(native, anatomy, reamer);
  return elapsed_us(begun) * 1e-3;
}

}  // namespace

ScoredReaming ream_and_score(const std::filesystem::path& data, const std::string& id, double duration_s) {
  ScoredReaming scored;
  scored.native_ms = native_ms_of(data);
  const std::filesystem::path folder = sessions_folder(data) / id;
  std::filesystem::create_directories(folder);
  session::Simulation simulation(session::build_setup(request_for(folder, duration_s), data));
  session::LoopRings rings(simulation.bone_case.bone.grid);
  simulation.state.brick_sender = &rings.sender;
  simulation.state.brick_budget = bricks_a_tick;
  const std::vector<uint8_t> start = simulation.bone_case.bone.coverage;
  LiveScoring live(simulation, start);
  session::SessionFiles files(simulation, folder, start.data(), session::SessionFiles::Trace::left_out);
  sim::HapticLoop loop(simulation.model, simulation.state, *simulation.device, rings.reports,
                       {false, sim::Realtime::off});
  const auto take_brick = [&](const voxel::BrickImage& image) {
    files.add(image);
    live.take(image);
  };
  const auto take_report = [&](const record::TickReport& report) { live.take(files.add(report)); };
  loop.start();
  while (!loop.ended()) {
    const bool late = files.recorder().waiting_chunks() > enough_waiting_chunks;
    if (late || !rings.drain(take_brick, take_report))
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  loop.stop();
  simulation.state.brick_sender = nullptr;
  rings.drain_rest(simulation.bone_case.bone, simulation.state.tick - 1, take_brick, take_report);
  const auto ended = SteadyClock::now();
  const nlohmann::json metrics = files.finish(loop.health()).metrics;
  scored.final_ms = elapsed_us(ended) * 1e-3;
  scored.duration_s = metrics.at("duration_s");
  scored.depth_mm = metrics.at("reaming_depth_mm");
  scored.removed_mm3 = metrics.at("removed_volume_mm3");
  scored.live_cpu_s = live.cpu_s();
  scored.measurements = live.measurements();
  scored.measurement_ms = live.measurements() > 0 ? 1e3 * live.measuring_s() / live.measurements() : 0.0;
  return scored;
}

}  // namespace ream::bench
