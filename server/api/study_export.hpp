#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "api/study.hpp"

namespace ream::api {

/// One session of a study, as an export needs it.
struct StudyAttempt {
  std::string participant;
  std::string case_id, script, device, device_profile;
  std::string state;        ///< the word of session.json
  std::string created_utc;  ///< used for order and day only; never told
  bool given_up = false;    ///< the participant went back to intact bone in a session of its own
  nlohmann::json metrics;   ///< metrics.json
};

/// A column of a table for statistics.
struct ExportColumn {
  std::string name;   ///< ends in its unit
  std::string unit;   ///< "mm3"; empty: none
  std::string words;  ///< what it is
};

struct ExportTable {
  std::string name;
  std::vector<ExportColumn> columns;
  std::vector<std::vector<nlohmann::json>> rows;  ///< null: not known; discarded: was never asked or answered
};

/// What leaves a study: no names, no ids of users or sessions, no dates; of time only the day since the
/// participant's first session.
struct StudyExport {
  ExportTable sessions;  ///< a row a session, by participant and attempt
  ExportTable answers;   ///< a row a participant
  ExportTable groups;    ///< a row an experience level and figure: n, median, quartiles
};

/// Attempts of participants that are not in the list are left out.
StudyExport export_of(const Study& study, const std::vector<Participant>& participants,
                      const std::vector<StudyAttempt>& attempts);

/// RFC 4180 with a line of column names. A text that a spreadsheet would take for a formula begins with '.
std::string csv_of(const ExportTable& table);
/// A list of objects by column name.
nlohmann::json json_of(const ExportTable& table);
/// What the columns of all tables mean.
nlohmann::json codebook_of(const Study& study, const StudyExport& all);

/// The quantile `share` of sorted values, linear between neighbours (R's type 7). Not of none.
double quantile(const std::vector<double>& sorted, double share);

}  // namespace ream::api
