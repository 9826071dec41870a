#pragma once
#include <condition_variable>
#include <mutex>
#include <thread>

#include "session/replay/metrics_timeline.hpp"
#include "session/replay/playhead.hpp"
#include "session/replay/replay_picture.hpp"
#include "session/running_replay.hpp"
#include "session/session_context.hpp"
#include "stream/fanout.hpp"

namespace ream::session {

/// The replay of a recording in the folder of a session: one thread moves its picture on as it is told.
class ReplaySession final : public RunningReplay {
 public:
  /// The bone of a recording.
  struct Bone {
    case_::Case start;                                   ///< before tick 0
    std::shared_ptr<const score::NativeGlenoid> native;  ///< null: the recording does not tell enough
  };

  /// Rests at the start, which viewers who join get at once. Errors: those of Recording and of case and tool;
  /// invalid_input when no tick was recorded; conflict when the case's bone is not the one that was recorded.
  ReplaySession(const SessionContext& context, const ReplayRequest& request);
  ~ReplaySession() override;

  PlaybackStatus status() const override;
  std::vector<ReplayMark> marks() const override;
  nlohmann::json metrics() const override;
  void change(const PlaybackChange& change) override;
  void stop() override;
  std::unique_ptr<net::WebSocketSession> subscribe(int stride) override;

 private:
  void follow();
  void show_moment(const ReplayMoment& moment, int64_t now_ns);
  void rest_with_fault(const std::string& words, uint32_t jump);
  std::vector<RecordingDamage> damage() const;
  stream::HelloInfo hello() const;

  const SessionContext context_;
  const ReplayRequest request_;
  const record::Recording recording_;
  const nlohmann::json kept_metrics_;  ///< of the session, at its end; or null
  const Bone bone_;
  const MetricsTimeline timeline_;
  const std::shared_ptr<stream::Fanout> fanout_;
  ReplayPicture picture_;  ///< of the thread, as the next two
  int64_t last_published_ns_ = 0;
  std::string logged_fault_;

  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable changed_;
  Playhead playhead_;
  std::string fault_;
  uint64_t bone_hash_ = 0;
  uint32_t bone_ticks_ = 0;
  std::optional<double> depth_mm_;  ///< as the picture's
  int64_t last_watched_ns_ = 0;
  bool ended_ = false;
  std::mutex stopping_;  ///< one stop() at a time
  std::thread follower_;
};

}  // namespace ream::session
