#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "record/op_log.hpp"
#include "session/folder/session_folder.hpp"
#include "session/live/reaming_session.hpp"
#include "session/live/session_recovery.hpp"
#include "session/live/stream_messages.hpp"
#include "session/scoring/kept_score.hpp"

namespace ream::session {
namespace {

SessionState end_state(sim::LoopEnd end) {
  if (end == sim::LoopEnd::finished) return SessionState::finished;
  return end == sim::LoopEnd::stopped ? SessionState::stopped : SessionState::fault;
}

}  // namespace

void ReamingSession::finish() {
  const sim::LoopHealth health = loop_.health();
  const SessionState state = end_state(health.end);
  const std::string fault = end_words(health.end);
  if (!fault.empty()) keep_black_box(loop_.black_box());
  publisher_.flush(steady_ns());
  note_health();
  const auto results = files_->finish(health, told_of(state, fault));
  keep_score(folder_, context_.data);
  close(state, fault, results.metrics);
}

/// Remarks that were accepted but that the recording did not get, as it had failed; in the order of
/// acceptance they are the last.
void ReamingSession::append_missing_remarks() {
  const record::Recording recording(recording_file(folder_));
  std::vector<record::Note> missing;
  {
    const std::lock_guard lock(mutex_);
    for (size_t i = recording.annotations().size(); i < annotations_.size(); ++i) {
      record::ops::Annotation remark = annotations_[i];
      remark.tick = std::min(remark.tick, recording.tick_count());
      missing.emplace_back(remark);
    }
  }
  if (!missing.empty()) record::append_notes(recording.log(), missing);
}

/// What was recorded up to here is closed as a fault, or, where it never went on, as what it was before; on a
/// disk that takes nothing more, the next start of the server does so.
void ReamingSession::end_without_force(const std::string& words) {
  log::error("session " + id_ + ": " + words);
  loop_.request_stop();
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  if (start_failure().empty()) keep_black_box(recent_);
  const SessionState state = start_failure().empty() ? SessionState::fault : state_without_start_;
  nlohmann::json metrics = this->metrics();
  try {
    files_->abandon(to_text(state), words);
    close_session_folder(folder_, context_.data, state, words);
    append_missing_remarks();
    metrics = read_json_file(metrics_json(folder_));
  } catch (const std::exception& e) {
    log::error("session " + id_ +
               " could not be closed; the next start of the server tries again: " + e.what());
  }
  close(state, words, metrics);
}

void ReamingSession::close(SessionState state, const std::string& fault, const nlohmann::json& metrics) {
  {
    const std::lock_guard lock(mutex_);
    status_.state = state;
    status_.fault = fault;
    status_.held = false;
    metrics_ = metrics;
    sample_.state = state;
    tell_port();  // before anybody who waits for the end goes on
    lock_.reset();
    place_.reset();
    finished_ = true;
  }
  changed_.notify_all();
  publish_state(state);
}

}  // namespace ream::session
