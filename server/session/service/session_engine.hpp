#pragma once
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "session/export/export_formats.hpp"
#include "session/running_replay.hpp"
#include "session/running_session.hpp"

namespace ream::session {

/// Computes metrics.json anew from what lies in sessions' folders. Keeps the case of the last session, as
/// many are of one. Used by one thread.
class SessionMeasurer {
 public:
  virtual ~SessionMeasurer() = default;
  /// Errors: those of the recording; cancelled.
  virtual nlohmann::json metrics(const std::filesystem::path& folder, const Progress& progress) = 0;
};

/// The simulation behind the services of sessions and replays; tests put one without bone in its place. One
/// a server. Called on worker threads, several at once; each function may take seconds.
class SessionEngine {
 public:
  virtual ~SessionEngine() = default;

  /// The program and its version: "ream 0.1.0".
  virtual std::string program() const = 0;

  /// Makes the case `demo` where it is not there yet; takes seconds.
  virtual void make_demo_case() = 0;

  /// A session ready to start. Errors: not_found (case, script), conflict (case without a plan),
  /// invalid_input, unavailable.
  virtual std::unique_ptr<RunningSession> make(const SessionRequest& request) = 0;
  /// One ready to go on from what lies in the folder of `request.id`; `reamer` empty: the same. Writes
  /// nothing yet. Errors: those of make(); conflict when another process has the session; not_found and
  /// invalid_input when there is no recording to go on from.
  virtual std::unique_ptr<RunningSession> resume(const SessionRequest& request,
                                                 const std::string& reamer) = 0;
  /// Opens a recording. Errors: not_found (recording, case), invalid_input, conflict (the case has changed
  /// since).
  virtual std::unique_ptr<RunningReplay> replay(const ReplayRequest& request) = 0;

  virtual std::unique_ptr<SessionMeasurer> measurer() const = 0;
  /// Writes the deviations of the surface that a session left (score/deviation.hpp). Errors: those of the
  /// recording and its case; io; cancelled.
  virtual void write_deviations(const std::filesystem::path& folder, const std::filesystem::path& json,
                                const Progress& progress) const = 0;

  /// Finds out in a moment what would make write_export fail at once. Errors: not_found, invalid_input.
  virtual void check_export(const ExportFormat& format, const ExportOrder& order) const = 0;
  /// Writes the file atomically from what lies in the session's folder. Errors: those of the recording and
  /// its case; io; cancelled.
  virtual void write_export(const ExportFormat& format, const ExportOrder& order,
                            const std::filesystem::path& out, const Progress& progress) const = 0;
};

}  // namespace ream::session
