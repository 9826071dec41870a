#pragma once
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "record/recorded_bone.hpp"
#include "score/depth_gauge.hpp"
#include "session/replay/metrics_timeline.hpp"
#include "stream/fanout.hpp"
#include "stream/mesh_publisher.hpp"

namespace ream::session {

/// What viewers of a replay are to see.
struct ReplayMoment {
  uint32_t position_ticks = 0;  ///< ticks that have passed, at most those of the recording
  uint32_t jump = 0;            ///< another number than before: the trace does not go on
  float speed = 1.0f;
  bool playing = false;
  std::string fault;  ///< why it cannot go on; empty: nothing is wrong
};

/// Shows moments of a recording to the viewers of a fanout: bone by its brick deltas, a quarter of a second
/// fine; poses, forces and metrics by its ticks. Used by one thread.
class ReplayPicture {
 public:
  /// Publishes the hello and the first whole picture. `before`: bone before tick 0; `native`: before its
  /// pilot hole was cut, null where the recording does not say what it is measured against; `hello` lacks
  /// only the tool. What is given outlives this, `hello` apart. Errors: those of Recording and of tools.
  ReplayPicture(const record::Recording& recording, const case_::Case& before,
                const std::shared_ptr<const score::NativeGlenoid>& native, const MetricsTimeline& timeline,
                stream::HelloInfo hello, stream::Fanout& fanout);

  /// Forwards without a jump every tick between is shown too. Error invalid_input for a damaged chunk: a jump
  /// has then changed nothing, and playing stands before that chunk.
  void show(const ReplayMoment& moment);
  /// Publishes what waits and is due; `now_ns` as steady_ns(); call every 10 ms or so.
  void poll(int64_t now_ns);
  /// Tells where the replay stands, now.
  void publish_state(SessionState state);

  /// Ticks of the recording that have passed in what is shown.
  uint32_t ticks() const { return shown_.position_ticks; }
  /// The bone that is shown: after how many ticks, and the hash of its coverage.
  uint32_t bone_ticks() const { return bone_.ticks(); }
  uint64_t bone_hash() const { return bone_.coverage_hash(); }
  /// How deep the reaming of that bone is, up to a tenth of a second old; empty: not known.
  std::optional<double> depth_mm() const { return depth_mm_; }

 private:
  void jump_to(const ReplayMoment& moment);
  void play_to(uint32_t ticks);
  void seek_bone(uint32_t ticks);
  void show_tool();
  void catch_up_metrics();
  void measure_depth(bool jumped);
  void show_metrics();
  void settle(const ReplayMoment& moment, uint32_t position_ticks);
  std::vector<record::ops::Tick> history_before(uint32_t end_tick) const;
  void publish_history(const std::vector<record::ops::Tick>& history);
  const record::ops::Tick& tick_at(uint32_t tick);

  const record::Recording& recording_;
  const Pose world_from_grid_;
  const MetricsTimeline& timeline_;
  stream::HelloInfo hello_;
  stream::Fanout& fanout_;
  const voxel::VoxelGrid grid_;
  record::RecordedBone bone_;
  std::optional<score::DepthGauge> gauge_;
  stream::MeshPublisher publisher_;
  stream::TelemetryBatcher batcher_;
  stream::TelemetrySample sample_;                    ///< the newest
  std::optional<score::MetricsAccumulator> metrics_;  ///< of what is shown; empty: not known yet
  std::optional<double> depth_mm_;
  uint32_t measured_ticks_ = UINT32_MAX;  ///< bone_.ticks() of depth_mm_
  int64_t depth_due_ns_ = 0;
  std::vector<record::ops::Tick> window_;  ///< of one chunk
  ReplayMoment shown_;
  size_t segment_ = 0;
};

}  // namespace ream::session
