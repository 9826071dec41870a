#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "core/session_state.hpp"
#include "geometry/pose.hpp"

namespace ream::stream {

class Fanout;

/// As Playback of proto/stream.fbs.
struct Playback {
  uint32_t position_ticks = 0;
  float speed = 1;
  bool playing = false;
  uint32_t jump = 0;
};

/// One tick as viewers see it. World frame, mm; forces N, torque N mm. No heap inside.
struct TelemetrySample {
  uint32_t tick = 0;
  float thrust_n = 0;      ///< simulated, along the tool's axis
  float hand_force_n = 0;  ///< magnitude sent to the hand
  float torque_n_mm = 0;
  float feed_rate_mm_s = 0;
  float density_g_cc = 0;  ///< mean of what is engaged, 0 without contact
  float vibration_g = 0;   ///< acceleration of the tool beside what contact does
  Pose world_from_tool, world_from_handle;
  std::optional<Pose> world_from_bone_rest;  ///< how far the bone has moved; empty: it is held rigidly
  bool spindle_on = false, irrigating = false, stalled = false;
  float spindle_speed_rad_s = 0;    ///< as simulated; reversed negative
  float surface_temperature_c = 0;  ///< of the bone under the reamer; 0: not simulated
  SessionState state = SessionState::created;
  float depth_mm = 0, removed_volume_mm3 = 0;
  float cortical_share = 0;
  float tick_mean_us = 0, tick_p99_us = 0;  ///< health of the loop
  uint32_t ticks_missed = 0;
  std::optional<Playback> playback;  ///< in replays only
  std::array<char, 160> fault{};     ///< words, zero-terminated, when state is fault

  /// Cut to what there is room for.
  void set_fault(std::string_view words) {
    fault.fill('\0');
    words.copy(fault.data(), fault.size() - 1);
  }
};

/// Samples that follow each other: tick of entry i is front().tick + i * tick_stride.
struct TelemetryBatch {
  uint32_t tick_stride = 1;
  uint32_t lost_before = 0;              ///< entries lost on the way here since the previous batch
  int64_t stamp_us = 0;                  ///< steady clock when it was published
  std::vector<TelemetrySample> samples;  ///< at least one
};

using SharedTelemetry = std::shared_ptr<const TelemetryBatch>;

/// From one batch to the next at least, unless a gap or flush() ends one sooner: about 60 a second.
inline constexpr int64_t telemetry_interval_ns = 15'000'000;

/// Collects samples and publishes them every telemetry_interval_ns. Used by one thread.
class TelemetryBatcher {
 public:
  /// Samples are expected every `tick_stride` ticks; a larger step ends the batch and counts as lost entries.
  explicit TelemetryBatcher(Fanout& fanout, uint32_t tick_stride = 1,
                            int64_t interval_ns = telemetry_interval_ns);

  /// Takes in a sample; publishes nothing but batches that this sample ends.
  void add(const TelemetrySample& sample);
  /// Publishes what was collected if the interval has passed since the last time; `now_ns` as steady_ns().
  void publish_if_due(int64_t now_ns);
  /// Publishes what was collected, now: the last samples of a session are not kept back.
  void flush();
  /// Publishes what was collected; the next sample may be of any tick and nothing between is lost.
  void jump();

 private:
  Fanout& fanout_;
  uint32_t tick_stride_;
  int64_t interval_ns_, next_publish_ns_ = 0;
  bool any_ = false;
  uint32_t last_tick_ = 0;
  TelemetryBatch batch_;
};

}  // namespace ream::stream
