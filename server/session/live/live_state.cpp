#include "session/live/live_state.hpp"

#include <chrono>
#include <utility>

#include "core/error.hpp"
#include "session/annotation.hpp"

namespace ream::session {
namespace {

/// A loop ticks again within a few ms, or stands still and its session ends by itself.
constexpr std::chrono::seconds max_wait{2};

}  // namespace

LiveState::LiveState(const SessionRequest& request, SessionStatus status,
                     std::vector<record::ops::Annotation> annotations)
    : status_(std::move(status)),
      labels_(request),
      annotations_(std::move(annotations)),
      recorded_annotations_(annotations_.size()) {}

void LiveState::refuse_start(const std::string& fault) {
  const std::lock_guard lock(mutex_);
  status_.state = SessionState::fault;
  status_.fault = fault;
}

void LiveState::fail_start(SessionState state, const std::string& fault) {
  std::unique_lock lock(mutex_);
  start_failure_ = {state, fault};
  changed_.wait(lock, [this] { return ended_; });
}

void LiveState::stop() {
  std::unique_lock lock(mutex_);
  if (begun_)
    changed_.wait(lock, [this] { return ended_; });
  else if (status_.state == SessionState::created)
    status_.state = SessionState::stopped;
}

void LiveState::wait_until_held(bool held) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, max_wait, [&] { return status_.held == held || ended_; });
}

bool LiveState::relabel(const SessionRequest& request) {
  std::unique_lock lock(mutex_);
  if (closing_) changed_.wait(lock, [this] { return ended_; });
  if (!is_live(status_.state)) return false;
  labels_ = request;
  relabelled_ = true;
  return true;
}

record::ops::Annotation LiveState::annotate(const NewAnnotation& note) {
  std::unique_lock lock(mutex_);
  if (closing_) changed_.wait(lock, [this] { return ended_; });
  if (!begun_ || ended_)
    throw Error(ErrorKind::conflict,
                "session '" + labels_.id + "' is " + to_text(status_.state) + "; a remark needs a recording");
  return annotations_.emplace_back(annotation_op(note, status_.tick));
}

std::vector<uint8_t> LiveState::coverage() {
  std::vector<uint8_t> coverage;
  const std::lock_guard one_at_a_time(copying_);
  std::unique_lock lock(mutex_);
  wanted_coverage_ = &coverage;
  if (changed_.wait_for(lock, max_wait, [this] { return wanted_coverage_ == nullptr; })) return coverage;
  wanted_coverage_ = nullptr;
  throw Error(ErrorKind::unavailable, "session '" + labels_.id + "' does not answer; try again");
}

void LiveState::begin() {
  const std::lock_guard lock(mutex_);
  begun_ = true;
  status_.state = SessionState::running;
}

std::optional<LiveState::Requests> LiveState::take_requests(bool loop_ended) {
  const std::lock_guard lock(mutex_);
  if (!begun_ || ended_) return std::nullopt;
  closing_ = loop_ended || start_failure_;
  Requests requests;
  requests.annotations.assign(annotations_.begin() + static_cast<std::ptrdiff_t>(recorded_annotations_),
                              annotations_.end());
  recorded_annotations_ = annotations_.size();
  if (std::exchange(relabelled_, false)) requests.labels = labels_;
  requests.start_failure = start_failure_;
  return requests;
}

void LiveState::give_coverage(const std::vector<uint8_t>& coverage) {
  const std::lock_guard lock(mutex_);
  if (wanted_coverage_ == nullptr) return;
  *std::exchange(wanted_coverage_, nullptr) = coverage;
  changed_.notify_all();
}

void LiveState::publish(const SessionStatus& status, nlohmann::json metrics) {
  const std::lock_guard lock(mutex_);
  const bool held_or_let_go = status.held != status_.held;
  status_ = status;
  if (!metrics.is_null()) metrics_ = std::move(metrics);
  if (held_or_let_go) changed_.notify_all();
}

std::vector<record::ops::Annotation> LiveState::close() {
  const std::lock_guard lock(mutex_);
  closing_ = true;
  return annotations_;
}

void LiveState::end(const SessionStatus& status, nlohmann::json metrics) {
  {
    const std::lock_guard lock(mutex_);
    status_ = status;
    metrics_ = std::move(metrics);
    ended_ = true;
  }
  changed_.notify_all();
}

void LiveState::end_as_fault() {
  {
    const std::lock_guard lock(mutex_);
    if (!ended_) status_.state = SessionState::fault;
    closing_ = ended_ = true;
  }
  changed_.notify_all();
}

}  // namespace ream::session
