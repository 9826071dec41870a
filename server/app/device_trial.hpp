#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/timing_histogram.hpp"
#include "device/haptic_device.hpp"
#include "sim/haptic_loop.hpp"

namespace ream::app {

/// How long the parts of a trial take.
struct TrialTimes {
  double wait_s = 60.0;  ///< at most, for the first pose
  double still_s = 1.0, wall_s = 4.0, ramp_down_s = 0.5;
};

/// What was seen of a device in a trial.
struct DeviceTrial {
  uint64_t ticks = 0, poses = 0;  ///< a pose counts when it is newer than the one before
  uint64_t wild_poses = 0;        ///< not numbers, or further than 2 m away
  uint64_t lost_ticks = 0;        ///< after the first pose
  double duration_s = 0.0;        ///< from the first pose on
  TimingSummary lateness_us;
  double age_p99_ms = 0.0, age_max_ms = 0.0;
  Vec3 moved_mm = Vec3::Zero();  ///< range along each axis of the world
  double force_max_n = 0.0;      ///< largest that was sent
  double wall_s = 0.0;           ///< in which the wall was touched
  bool connected = false, device_fault = false, interrupted = false;
  double fade_ms = 0.0;  ///< StaleLimits of the device

  double pose_rate_hz() const { return duration_s > 0.0 ? static_cast<double>(poses) / duration_s : 0.0; }
};

/// Tries out a device (world frame, see MappedDevice), on the calling thread: no force for a while, then a
/// gentle wall that holds against the hand 10 mm below where the handle was (world: towards the feet), then
/// the force falls to nothing. Never more than 1 N or a tenth of what the device can do. The calling thread
/// is given real-time priority as `realtime` says and where it is granted. The device is left without force
/// and closed, on whatever way out. Errors: those of open().
DeviceTrial try_out(device::HapticDevice& device, const TrialTimes& times, sim::Realtime realtime);

/// What to make of it, one line each; the first says whether the device can be used.
std::vector<std::string> verdict_words(const DeviceTrial& trial);
bool is_usable(const DeviceTrial& trial);
nlohmann::json to_json(const DeviceTrial& trial);

}  // namespace ream::app
