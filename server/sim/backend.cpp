#include "sim/backend.hpp"

#include <algorithm>

#include "collide/contact/narrow_phase_cl.hpp"
#include "collide/removal/removal_cl.hpp"
#include "core/clock.hpp"
#include "core/error.hpp"
#include "core/timing_histogram.hpp"
#include "sim/tick_trial.hpp"

namespace ream::sim {
namespace {

std::string timings_text(const std::vector<BackendTiming>& timings) {
  std::string text = "measured";
  for (const BackendTiming& t : timings) {
    text += (&t == timings.data() ? " " : ", ") + t.name + ": ";
    text += t.failure.empty() ? std::to_string(static_cast<int>(t.p50_us)) + " us, slow ones " +
                                    std::to_string(static_cast<int>(t.slow_us)) + " us"
                              : t.failure;
  }
  return text;
}

constexpr int warm_looks = 50, max_rounds = 40, looks_a_round = 25;
/// Of all trials together: where a tick is long, fewer rounds are enough to tell the candidates apart.
constexpr double enough_s = 1.0;
constexpr double enough_engaged = 0.02;  ///< share of the points

/// A backend on trial.
struct Candidate {
  Backend backend;
  TimingHistogram times;
  std::vector<double> slowest_us;  ///< of each round
};

/// False when the device failed.
bool run_round(const TickTrial& trial, double depth_mm, int first, int count, bool counts,
               Candidate& candidate) {
  double slowest = 0.0;
  for (int i = 0; i < count; ++i) {
    const double us = trial.tick_us(candidate.backend, depth_mm, first + i);
    if (us < 0.0) return false;
    slowest = std::max(slowest, us);
    if (counts) candidate.times.add(us);
  }
  if (counts) candidate.slowest_us.push_back(slowest);
  return true;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// All that can be had, and a timing for each device, with the reason where it cannot.
std::vector<Candidate> candidates_of(const Model& model, voxel::BoneModel& bone,
                                     const voxel::SolidCells& cells, std::vector<BackendTiming>& timings) {
  std::vector<Candidate> candidates(1);
  candidates[0].backend = make_cpp_backend(model, bone, cells);
  timings.assign(1, {});
  for (const gpu::Device& device : gpu::list_devices()) {
    BackendTiming timing;
    timing.wakes_threads = device.is_pocl && !device.name.starts_with("basic");
    candidates.emplace_back();
    try {
      candidates.back().backend = make_opencl_backend(model, bone, cells, device);
    } catch (const Error& e) {
      timing.failure = e.what();
    }
    timing.name = "opencl: " + device.name;
    timings.push_back(std::move(timing));
  }
  timings[0].name = candidates[0].backend.name;
  return candidates;
}

}  // namespace

Backend make_cpp_backend(const Model& model, voxel::BoneModel& bone, const voxel::SolidCells& cells) {
  Backend backend;
  backend.name = "cpu";
  backend.narrow_phase =
      collide::make_narrow_phase_cpu({model.contact_shell, bone, model.distance, cells, model.resistances});
  if (model.settings.removal == RemovalLaw::decay)
    backend.decay = collide::make_decay_cpu({model.decay_shell, bone, model.settings.decay_levels});
  else
    backend.removal = collide::make_removal_cpu({model.profile, bone});
  return backend;
}

Backend make_opencl_backend(const Model& model, voxel::BoneModel& bone, const voxel::SolidCells& cells,
                            const gpu::Device& device) {
  const auto buffers = std::make_shared<collide::BoneBuffers>(device, bone);
  const auto shape = collide::LaunchShape::fitting(device);
  Backend backend;
  backend.name = "opencl: " + device.name;
  backend.narrow_phase = collide::make_narrow_phase_cl(
      {model.contact_shell, bone, model.distance, cells, model.resistances}, buffers, shape);
  if (model.settings.removal == RemovalLaw::decay)
    backend.decay =
        collide::make_decay_cl({model.decay_shell, bone, model.settings.decay_levels}, buffers, shape);
  else
    backend.removal = collide::make_removal_cl({model.profile, bone}, buffers, shape);
  return backend;
}

Backend make_backend(const Model& model, voxel::BoneModel& bone, const voxel::SolidCells& cells) {
  const std::string& requested = model.settings.backend;
  if (requested == "cpu") return make_cpp_backend(model, bone, cells);
  if (requested == "auto") {
    std::vector<BackendTiming> timings;
    Backend backend = make_measured_backend(model, bone, cells, timings);
    backend.choice = timings_text(timings);
    return backend;
  }
  if (!requested.starts_with("opencl"))
    throw Error(ErrorKind::usage,
                "backend '" + requested + "' is not known; use auto, cpu, opencl or opencl:N");
  return make_opencl_backend(model, bone, cells, gpu::choose_device(requested, gpu::Use::tick));
}

bool is_quicker(const BackendTiming& a, const BackendTiming& than) {
  if (!a.failure.empty() || !than.failure.empty()) return a.failure.empty();
  return a.slow_us < than.slow_us && (!a.wakes_threads || a.p999_us < than.p999_us);
}

Backend make_measured_backend(const Model& model, voxel::BoneModel& bone, const voxel::SolidCells& cells,
                              std::vector<BackendTiming>& timings) {
  std::vector<Candidate> candidates = candidates_of(model, bone, cells, timings);
  const TickTrial trial(model, bone, cells);
  const double depth_mm = trial.pressed_depth_mm(*candidates[0].backend.narrow_phase, enough_engaged);
  const auto start = SteadyClock::now();
  for (int round = 0; round <= max_rounds && (round < 2 || elapsed_us(start) < enough_s * 1e6); ++round)
    for (size_t i = 0; i < candidates.size(); ++i) {
      const bool warming = round == 0;
      const int first = warming ? 0 : warm_looks + (round - 1) * looks_a_round;
      if (timings[i].failure.empty() &&
          !run_round(trial, depth_mm, first, warming ? warm_looks : looks_a_round, !warming, candidates[i]))
        timings[i].failure = "failed while it was measured";
    }
  size_t best = 0;
  for (size_t i = 0; i < candidates.size(); ++i) {
    const TimingSummary summary = candidates[i].times.summary();
    timings[i].p50_us = summary.p50_us;
    timings[i].p999_us = summary.p999_us;
    timings[i].slow_us = median(candidates[i].slowest_us);
    if (is_quicker(timings[i], timings[best])) best = i;
  }
  return std::move(candidates[best].backend);
}

}  // namespace ream::sim
