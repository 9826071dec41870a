#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/file_lock.hpp"
#include "core/session_state.hpp"
#include "record/recorded_bone.hpp"
#include "score/metrics.hpp"
#include "session/simulation/simulation.hpp"

namespace ream::session {

/// Where a session that was interrupted or stopped goes on: its recording read to the end, its bone as it was
/// then, its metrics up to there. Writes nothing. Stays where it is, as the bone refers to the recording.
class ResumePoint {
 public:
  /// `folder`: of the session; locked for as long as this lives, or until the lock is taken. Errors: conflict
  /// when a process has the session, its recording is damaged (to go on would cut off what follows the
  /// damage) or its case has changed; not_found and invalid_input for recording and case.
  ResumePoint(const std::filesystem::path& folder, const std::filesystem::path& data);
  ResumePoint(const ResumePoint&) = delete;
  ResumePoint& operator=(const ResumePoint&) = delete;

  /// What a simulation is made of that goes on from here with the recorded settings, under a script that
  /// begins anew. `request`: backend, script and device count. `reamer`: words, or empty for the one before.
  /// To be called once. Error invalid_input for the reamer; those of script and device.
  SimulationSetup setup(const RunRequest& request, const std::string& reamer);

  /// Undoes what was appended to the recording since it was read; nobody may be writing it. On a failure it
  /// says so in the log.
  void cut_to_its_end() const;

  /// Of the session, as its folder has it.
  SessionState state() const { return state_; }
  /// Ticks that were recorded; the next is theirs.
  uint32_t ticks() const { return recording_.tick_count(); }
  const record::Recording& recording() const { return recording_; }
  const record::RecordedBone& bone() const { return bone_; }
  /// Of the bone before the session's first tick.
  const std::vector<uint8_t>& start_coverage() const { return start_coverage_; }
  const score::MetricsAccumulator& metrics() const { return metrics_; }
  FileLock take_lock() { return std::move(lock_); }

 private:
  const std::filesystem::path data_;
  FileLock lock_;
  record::Recording recording_;
  case_::Case case_;
  const std::vector<uint8_t> start_coverage_;
  record::RecordedBone bone_;
  score::MetricsAccumulator metrics_;
  const SessionState state_;
};

/// The lock of a session's folder, which exists. Error conflict when somebody else has it.
FileLock locked(const std::filesystem::path& folder);

}  // namespace ream::session
