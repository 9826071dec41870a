#pragma once
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "net/websocket.hpp"

namespace ream::session {

inline constexpr double slowest_playback = 0.1, fastest_playback = 16.0;

/// What is to be replayed.
struct ReplayRequest {
  std::string id;         ///< of the replay, given by the server
  std::string replay_of;  ///< id of a session that has ended
  std::string case_id, script;
  std::string counted_for = {};  ///< whose places it takes (ReplayLimits::of_caller); empty: not limited
  bool blind = false;            ///< does not say which session it is of, nor its marks and metrics
};

/// A moment that is worth finding.
struct ReplayMark {
  double at_s = 0.0;
  std::string
      kind;  ///< "annotation", "damaged", or what the recording calls the event: failover, interrupted, ...
  std::string words;  ///< for people; may be empty
};

/// Where a replay stands.
struct PlaybackStatus {
  double position_s = 0.0, duration_s = 0.0;
  double speed = 1.0;  ///< seconds of the recording a second, also while it rests
  bool playing = false;
  std::string fault;         ///< why it cannot go on from here; empty: nothing is wrong
  std::string warning;       ///< what of the recording is damaged, as far as known; empty: nothing
  double force_scale = 1.0;  ///< simulated N per hand N
  double unwatched_s = 0.0;  ///< since the last viewer left
};

/// What to change; what is absent stays as it is.
struct PlaybackChange {
  std::optional<bool> playing;
  std::optional<double> speed;       ///< slowest_playback to fastest_playback; 0 rests and keeps the speed
  std::optional<double> position_s;  ///< 0 to the duration
};

/// A recording that is shown as the session was, at any speed, to any number of viewers. Called from several
/// worker threads at once. Destroying it stops it.
class RunningReplay {
 public:
  virtual ~RunningReplay() = default;

  virtual PlaybackStatus status() const = 0;
  /// In order of time.
  virtual std::vector<ReplayMark> marks() const = 0;
  /// The keys of metrics.json, up to the moment shown. Errors: unavailable while the recording has not been
  /// read up to there; invalid_input when it is damaged before.
  virtual nlohmann::json metrics() const = 0;

  /// Returns at once; what viewers see follows. From the end, playing begins at the start again. Error
  /// invalid_input for numbers out of range.
  virtual void change(const PlaybackChange& change) = 0;
  /// Tells the viewers that it has ended.
  virtual void stop() = 0;

  /// As RunningSession::subscribe.
  virtual std::unique_ptr<net::WebSocketSession> subscribe(int stride) = 0;
};

}  // namespace ream::session
