#pragma once
#include <nlohmann/json.hpp>
#include <vector>

#include "score/rubric_score.hpp"
#include "session/scoring/ended_sessions.hpp"
#include "session/scoring/export_table.hpp"

namespace ream::session {

/// One row a session: who (a code where there is one, never a name), when, with what; result and points by
/// the rubric; then every metric of the catalogue, its unit at the end of its name. What is not said is an
/// empty cell. Their metrics have been read.
ExportTable score_table(const std::vector<EndedSession>& sessions, const score::Rubric& rubric);

/// What the columns of such a table mean, one row each: name, unit, words, source, evidence, limits.
ExportTable score_codebook(const ExportTable& table);

}  // namespace ream::session
