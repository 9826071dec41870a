#include "app/device_trial.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/numbers.hpp"
#include "core/clock.hpp"
#include "core/interrupt.hpp"
#include "device/crash_guard.hpp"
#include "device/haptic_device.hpp"
#include "sim/realtime.hpp"
#include "sim/watchdogs.hpp"

namespace ream::app {
namespace {

using device::LinkState;

const Vec3 world_up = Vec3::UnitZ();  // the world is LPS
constexpr double wall_below_mm = 10.0;
constexpr double wall_stiffness_n_mm = 0.2, share_of_stiffness = 0.25;
constexpr double max_force_n = 1.0, share_of_force = 0.1;
constexpr double max_distance_mm = 2000.0;
constexpr double min_motion_mm = 1.0;
constexpr double few_poses_hz = 200.0;

class Trial {
 public:
  Trial(device::HapticDevice& device, const TrialTimes& times)
      : device_(device), times_(times), watchdog_(device.traits().stale) {
    const device::DeviceTraits& traits = device.traits();
    stiffness_n_mm_ = std::min(wall_stiffness_n_mm, share_of_stiffness * traits.stiffness_max_n_mm);
    force_max_n_ = std::min(max_force_n, share_of_force * traits.force_max_n);
    seen_.fade_ms = traits.stale.fade_ms;
  }

  DeviceTrial run(bool realtime) {
    sim::LoopGuard guard(device_, sim::LoopGuard::limit_for(device_.traits()), realtime);
    sim::TickClock clock;
    while (guard.beat() && !over()) {
      if (interrupted()) {
        seen_.interrupted = true;
        break;
      }
      const double lateness_us = clock.wait();
      if (!tick(lateness_us)) break;
    }
    guard.end();
    return result();
  }

 private:
  double since_first_s() const { return static_cast<double>(ticks_since_first_) * tick_s; }
  double length_s() const { return times_.still_s + times_.wall_s + times_.ramp_down_s; }
  bool over() const {
    if (!seen_.connected) return static_cast<double>(seen_.ticks) * tick_s >= times_.wait_s;
    return ticks_since_first_ >= static_cast<uint64_t>(std::llround(length_s() / tick_s));
  }

  /// False when the device can give or take nothing any more.
  bool tick(double lateness_us) {
    const device::DeviceStatus status = device_.read(input_);
    if (status == device::DeviceStatus::finished) return false;
    seen_.device_fault = status != device::DeviceStatus::ok;
    if (seen_.device_fault) return false;
    ++seen_.ticks;
    device::DeviceInput trusted = input_;
    const LinkState link = watchdog_.judge(static_cast<uint32_t>(seen_.ticks), trusted);
    if (link != LinkState::lost) begin();
    if (seen_.connected) watch(trusted, link, lateness_us);
    device::DeviceOutput output;
    if (link == LinkState::fresh || link == LinkState::held) output.force_n = force_n(trusted);
    output.world_from_tool = trusted.world_from_handle;
    seen_.force_max_n = std::max(seen_.force_max_n, output.force_n.norm());
    seen_.device_fault = device_.write(output) != device::DeviceStatus::ok;
    return !seen_.device_fault;
  }

  void begin() {
    if (seen_.connected) return;
    seen_.connected = true;
    last_age_ms_ = input_.age_ms + 1.0;
  }

  void watch(const device::DeviceInput& input, LinkState link, double lateness_us) {
    ++ticks_since_first_;
    lateness_us_.add(lateness_us);
    if (link == LinkState::lost) ++seen_.lost_ticks;
    if (std::isfinite(input.age_ms)) {
      // A pose that were not new would be older by a whole tick.
      if (input.age_ms < last_age_ms_ + 0.5) ++seen_.poses;
      last_age_ms_ = input.age_ms;
      ages_us_.add(1e3 * input.age_ms);
      seen_.age_max_ms = std::max(seen_.age_max_ms, input.age_ms);
    }
    const Vec3& place_mm = input.world_from_handle.translation_mm;
    if (!input.world_from_handle.rotation.allFinite() || !(place_mm.array().abs() < max_distance_mm).all()) {
      ++seen_.wild_poses;
      return;
    }
    range_mm_.extend(place_mm);
    if (since_first_s() <= times_.still_s) wall_mm_ = place_mm.dot(world_up) - wall_below_mm;
  }

  Vec3 force_n(const device::DeviceInput& input) {
    const double t_s = since_first_s() - times_.still_s;
    const double depth_mm = wall_mm_ - input.world_from_handle.translation_mm.dot(world_up);
    if (t_s <= 0.0 || input.paused || !(depth_mm > 0.0)) return Vec3::Zero();
    seen_.wall_s += tick_s;
    const double gain = std::clamp((times_.wall_s + times_.ramp_down_s - t_s) / times_.ramp_down_s, 0.0, 1.0);
    return gain * std::min(stiffness_n_mm_ * depth_mm, force_max_n_) * world_up;
  }

  DeviceTrial result() const {
    DeviceTrial seen = seen_;
    seen.duration_s = since_first_s();
    seen.lateness_us = lateness_us_.summary();
    seen.age_p99_ms = 1e-3 * ages_us_.summary().p99_us;
    if (!range_mm_.isEmpty()) seen.moved_mm = range_mm_.sizes();
    return seen;
  }

  device::HapticDevice& device_;
  const TrialTimes times_;
  sim::PoseWatchdog watchdog_;
  double stiffness_n_mm_ = 0.0, force_max_n_ = 0.0;
  device::DeviceInput input_;
  DeviceTrial seen_;
  uint64_t ticks_since_first_ = 0;
  double last_age_ms_ = 0.0, wall_mm_ = 0.0;  ///< height of the wall along `world_up`
  TimingHistogram lateness_us_, ages_us_;
  Eigen::AlignedBox3d range_mm_;
};

}  // namespace

DeviceTrial try_out(device::HapticDevice& device, const TrialTimes& times, sim::Realtime realtime) {
  const device::CrashWatch crash_watch(device);
  device.open();
  const device::DeviceGuard device_guard(device);
  sim::ask_for_realtime(realtime, -1);
  // Histograms are too large for a stack that others use, too.
  const auto trial = std::make_unique<Trial>(device, times);
  return trial->run(realtime != sim::Realtime::off);
}

bool is_usable(const DeviceTrial& t) {
  return t.connected && !t.device_fault && t.wild_poses == 0 && t.lost_ticks == 0 && t.age_p99_ms < t.fade_ms;
}

std::vector<std::string> verdict_words(const DeviceTrial& t) {
  std::vector<std::string> words;
  if (t.interrupted) words.push_back("interrupted; the force is off");
  if (t.device_fault)
    words.push_back("not usable: the device reported a fault; check its cable and power");
  else if (!t.connected)
    words.push_back("not usable: no pose came; check that the device is there and connected");
  else if (t.wild_poses > 0)
    words.push_back("not usable: " + std::to_string(t.wild_poses) +
                    " poses were not numbers, or more than 2 m away");
  else if (t.lost_ticks > 0)
    words.push_back("not usable: it stopped answering for " + std::to_string(t.lost_ticks) + " ms");
  else if (t.age_p99_ms >= t.fade_ms)
    words.push_back("not usable: 1 % of the poses were older than " + rounded(t.age_p99_ms, 0) +
                    " ms, and from " + rounded(t.fade_ms, 0) +
                    " ms on the force fades; use a wire instead of radio, or a faster sender");
  else
    words.push_back("usable");
  if (!t.connected) return words;
  if (t.moved_mm.norm() < min_motion_mm)
    words.push_back("the handle did not move, so its axes were not seen");
  else if (t.wall_s == 0.0)
    words.push_back("the wall was not touched; press downwards to feel it");
  if (t.pose_rate_hz() < few_poses_hz)
    words.push_back("few poses: " + rounded(t.pose_rate_hz(), 0) + " a second; 1000 feel best");
  return words;
}

nlohmann::json to_json(const DeviceTrial& t) {
  return {{"usable", is_usable(t)},
          {"verdict", verdict_words(t)},
          {"duration_s", t.duration_s},
          {"ticks", t.ticks},
          {"pose_rate_hz", t.pose_rate_hz()},
          {"pose_age_ms", {{"p99", t.age_p99_ms}, {"max", t.age_max_ms}}},
          {"lateness_us",
           {{"p50", t.lateness_us.p50_us}, {"p99", t.lateness_us.p99_us}, {"max", t.lateness_us.max_us}}},
          {"wild_poses", t.wild_poses},
          {"lost_ms", t.lost_ticks},
          {"moved_mm", {t.moved_mm.x(), t.moved_mm.y(), t.moved_mm.z()}},
          {"force_max_n", t.force_max_n},
          {"wall_s", t.wall_s}};
}

}  // namespace ream::app
