#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "session/running_session.hpp"

namespace ream::jobs {

enum class JobState { waiting, running, done, failed, cancelled };
/// The word of REST: "waiting", "running", ...
std::string to_text(JobState state);
/// Whether it waits or runs.
bool is_open(JobState state);

/// What somebody wants done.
struct JobOrder {
  std::string kind;             ///< import, segmentation, build, export, mesh, snapshot
  std::string case_id = {};     ///< case that it works on; empty: on none
  std::string session_id = {};  ///< session that it works on; empty: on none
  /// The session that it is about: who may see that may know of the work, besides operators and instructors.
  std::shared_ptr<const session::SessionRequest> session = nullptr;
  std::string counted_for = {};  ///< whose places it takes (JobOptions::of_caller); empty: not limited
  /// Of what is made from somebody's file: the user who sent it. Why it failed may name the file, and files
  /// are named after patients.
  std::optional<std::string> sender = std::nullopt;
};

/// A file that work has made, to be fetched for a while.
struct JobResult {
  std::filesystem::path path;
  std::string media_type;
  uint64_t bytes = 0;
};

/// Long work, as clients see it.
struct JobRecord {
  std::string id;
  uint64_t number = 0;  ///< 1 for the first of this server, and so on
  JobOrder order;
  JobState state = JobState::waiting;
  double share = 0.0;  ///< how far it is, 0 to 1
  std::string step;    ///< what it does now, for people
  ErrorKind problem_kind = ErrorKind::io;
  std::string problem;  ///< why it failed; else empty
  std::string created_utc, ended_utc;
  std::optional<JobResult> result;
};

}  // namespace ream::jobs
