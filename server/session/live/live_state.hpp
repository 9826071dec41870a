#pragma once
#include <condition_variable>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "record/ops.hpp"
#include "session/running_session.hpp"

namespace ream::session {

/// What the commands of a live session (any thread) and its follower (one thread) tell each other, behind one
/// mutex. A session has *begun* once its follower has files, is *closing* as soon as nothing more gets into
/// its recording, and has *ended* when its files are closed and another process may have them.
class LiveState {
 public:
  /// `annotations`: those that its recording has already.
  LiveState(const SessionRequest& request, SessionStatus status,
            std::vector<record::ops::Annotation> annotations);

  SessionStatus status() const { return read(status_); }
  nlohmann::json metrics() const { return read(metrics_); }
  /// The request with its labels as they are now.
  SessionRequest labels() const { return read(labels_); }
  /// All that were accepted, in this order.
  std::vector<record::ops::Annotation> annotations() const { return read(annotations_); }

  // Commands. Those that wait, wait for the follower.

  /// The start failed before there were files.
  void refuse_start(const std::string& fault);
  /// The start failed with the files open: the follower closes them as `state`. Waits for the end.
  void fail_start(SessionState state, const std::string& fault);
  /// One that has not begun is stopped for good; of another the end is waited for.
  void stop();
  /// Waits until a tick has been paused, or not, as commanded; but not for a loop that stands still.
  void wait_until_held(bool held);
  /// See RunningSession::relabel.
  bool relabel(const SessionRequest& request);
  /// See RunningSession::annotate.
  record::ops::Annotation annotate(const NewAnnotation& note);
  /// The bone as viewers have it, which is the follower's. Error unavailable when it does not answer.
  std::vector<uint8_t> coverage();

  // The follower.

  struct StartFailure {
    SessionState state;
    std::string fault;
  };
  /// What commands want of it since it asked last.
  struct Requests {
    std::vector<record::ops::Annotation> annotations;
    std::optional<SessionRequest> labels;
    std::optional<StartFailure> start_failure;
  };
  /// There are files: the session runs.
  void begin();
  /// None unless the session has begun and not ended. From `loop_ended` or a failed start on it is closing.
  std::optional<Requests> take_requests(bool loop_ended);
  /// Gives `coverage` to who waits for it.
  void give_coverage(const std::vector<uint8_t>& coverage);
  /// `metrics` null: those before.
  void publish(const SessionStatus& status, nlohmann::json metrics = nullptr);
  /// It is closing. Returns the annotations that were accepted.
  std::vector<record::ops::Annotation> close();
  void end(const SessionStatus& status, nlohmann::json metrics);
  /// The follower itself failed.
  void end_as_fault();

 private:
  template <typename T>
  T read(const T& member) const {
    const std::lock_guard lock(mutex_);
    return member;
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  SessionStatus status_;
  nlohmann::json metrics_;
  SessionRequest labels_;
  bool relabelled_ = false;  ///< for the follower to write down
  std::vector<record::ops::Annotation> annotations_;
  size_t recorded_annotations_;                      ///< of them; the rest is for the follower to record
  std::vector<uint8_t>* wanted_coverage_ = nullptr;  ///< for the follower to fill; null: none is wanted
  std::mutex copying_;  ///< one caller of coverage() at a time; locked before mutex_
  std::optional<StartFailure> start_failure_;
  bool begun_ = false, closing_ = false, ended_ = false;
};

}  // namespace ream::session
