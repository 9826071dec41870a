#pragma once
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "record/recording.hpp"
#include "score/metrics.hpp"

namespace ream::session {

/// Where a recording cannot be read any further.
struct RecordingDamage {
  uint32_t after_ticks = 0;  ///< ticks before it
  std::string words;         ///< empty: none has been found
};

/// Metrics of a recording at any of its moments. A thread of its own reads the recording once from the start
/// and keeps what was accumulated after each second; a moment costs the ticks since the last whole second.
class MetricsTimeline {
 public:
  /// `start`: before the first tick. The recording outlives this.
  MetricsTimeline(const record::Recording& recording, const Pose& world_from_grid,
                  const score::MetricsAccumulator& start);
  ~MetricsTimeline();
  MetricsTimeline(const MetricsTimeline&) = delete;
  MetricsTimeline& operator=(const MetricsTimeline&) = delete;

  /// After `ticks` ticks; nothing when the recording has not been read up to there yet, or is damaged before.
  std::optional<score::MetricsAccumulator> at(uint32_t ticks) const;
  /// The same, waiting for it. Errors: unavailable when `timeout` is over, invalid_input when the recording
  /// is damaged before.
  score::MetricsAccumulator wait_for(uint32_t ticks, std::chrono::milliseconds timeout) const;
  /// The first damage among the ticks, as far as the recording has been read.
  RecordingDamage damage() const;

 private:
  void read_all();
  score::MetricsAccumulator from_second(const score::MetricsAccumulator& second, uint32_t ticks) const;

  const record::Recording& recording_;
  const Pose world_from_grid_;
  mutable std::mutex mutex_;  ///< guards what follows
  mutable std::condition_variable grown_;
  std::vector<score::MetricsAccumulator> seconds_;  ///< entry i: after i seconds
  uint32_t reached_ticks_ = 0;                      ///< ticks that have been read
  std::string damage_;
  bool done_ = false, stopping_ = false;
  std::thread reader_;
};

}  // namespace ream::session
