#pragma once
#include "session/scoring/export_table.hpp"
#include "study/validity_report.hpp"

namespace ream::study {

/// Tables for statistics elsewhere. proto/analysis/validity.R reads the first two as sessions.csv and
/// ratings.csv and computes the third.

/// session, participant, experience, arm, phase, attempt (0: not known), then a column per measure.
session::ExportTable validity_sessions_table(const ValidityInput& input);

/// rater, session, item, kind ("scale" or "check"), value.
session::ExportTable validity_ratings_table(const ValidityInput& input);

/// All numbers of the report, one row each: result, measure, statistic, value. `result` is the name of the
/// part as in validity_json(), then ":" and the subject where there is one.
session::ExportTable validity_numbers_table(const ValidityReport& report);

}  // namespace ream::study
