#pragma once
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "api/audit.hpp"
#include "api/benchmark_store.hpp"
#include "api/change_feed.hpp"
#include "api/job_service.hpp"
#include "api/quiet_work.hpp"
#include "api/replay_service.hpp"
#include "api/score_document.hpp"
#include "api/session_service.hpp"
#include "api/study_service.hpp"
#include "net/router.hpp"
#include "score/rubric_store.hpp"

namespace ream::api {

/// Computes metrics.json anew from what lies in a session's folder. Errors: those of the recording;
/// cancelled. Used by one thread; keeps the case of the last session, as many are of one.
using Measure = std::function<nlohmann::json(const std::filesystem::path& folder, const Progress& progress)>;

/// What scores need of the program around.
struct ScoreMakers {
  std::string scored_by = "ream";  ///< program and version
  std::function<Measure()> make_measure;
  /// Writes the deviations of the surface that a session left (score/deviation_file.hpp). Errors: those of
  /// the recording and its case; io; cancelled.
  std::function<void(const std::filesystem::path& folder, const std::filesystem::path& json,
                     const Progress& progress)>
      write_deviation;
};

/// Rubrics and benchmarks of a data folder.
struct ScoreStores {
  score::RubricStore rubrics;
  BenchmarkStore benchmarks;
  bool writable = true;  ///< false: there is no data folder

  /// "id" or "id@version"; empty: the newest standard one. Errors: not_found; invalid_input for a damaged
  /// one.
  Judge judge_by(const std::string& rubric, const std::string& benchmark = {}) const;
};

/// What the resources of scores share. All of it outlives the router.
struct ScoreTools {
  SessionService& sessions;
  const ReplayService& replays;
  const StudyService* studies;  ///< null: there are none
  JobService& jobs;
  QuietWork& quiet;
  ChangeFeed& feed;
  const ScoreStores& stores;
  const ScoreMakers& makers;
  Audit audit;
};

/// /api/v1/rubrics: versions are added, never changed.
void add_rubric_routes(net::Router& router, const ScoreTools& tools);
/// /api/v1/benchmarks: what experts reach, and pass marks by contrasting groups.
void add_benchmark_routes(net::Router& router, const ScoreTools& tools);
/// /api/v1/sessions/{id}/score, and /api/v1/scores, a table for statistics.
void add_score_routes(net::Router& router, const ScoreTools& tools);
/// POST /api/v1/rescorings: a job over many sessions.
void add_rescoring_routes(net::Router& router, const ScoreTools& tools);
/// GET /api/v1/sessions/{id}/deviation.
void add_deviation_routes(net::Router& router, const ScoreTools& tools);
/// GET /api/v1/learning: a trainee's sessions in order of time.
void add_learning_routes(net::Router& router, const ScoreTools& tools);

}  // namespace ream::api
