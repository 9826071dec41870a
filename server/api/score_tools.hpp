#pragma once
#include <filesystem>
#include <string>

#include "api/audit.hpp"
#include "api/change_feed.hpp"
#include "jobs/job_service.hpp"
#include "jobs/low_priority_executor.hpp"
#include "net/router.hpp"
#include "score/benchmark_store.hpp"
#include "score/rubric_store.hpp"
#include "session/scoring/score_document.hpp"
#include "session/service/replay_service.hpp"
#include "session/service/session_service.hpp"
#include "study/study_service.hpp"

namespace ream::api {

/// Rubrics and benchmarks of a data folder.
struct ScoreStores {
  score::RubricStore rubrics;
  score::BenchmarkStore benchmarks;
  bool writable = true;  ///< false: there is no data folder

  /// "id" or "id@version"; empty: the newest standard one. Errors: not_found; invalid_input for a damaged
  /// one.
  session::Judge judge_by(const std::string& rubric, const std::string& benchmark = {}) const;
};

/// What the resources of scores share. All of it outlives the router.
struct ScoreTools {
  session::SessionService& sessions;
  const session::ReplayService& replays;
  const study::StudyService* studies;  ///< null: there are none
  jobs::JobService& jobs;
  jobs::LowPriorityExecutor& executor;
  ChangeFeed& feed;
  const ScoreStores& stores;
  session::SessionEngine& engine;
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
