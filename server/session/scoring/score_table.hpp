#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "score/rubric_score.hpp"
#include "session/scoring/export_table.hpp"

namespace ream::session {

/// A session for statistics: its session.json (or what its recording says of it) and its metrics.json.
struct TableSession {
  std::string id;
  nlohmann::json session, metrics;
};

/// One row a session: who (a code where there is one, never a name), when, with what; result and points by
/// the rubric; then every metric of the catalogue, its unit at the end of its name. What is not said is an
/// empty cell.
ExportTable score_table(const std::vector<TableSession>& sessions, const score::Rubric& rubric);

/// What the columns of such a table mean, one row each: name, unit, words, source, evidence, limits.
ExportTable score_codebook(const ExportTable& table);

}  // namespace ream::session
