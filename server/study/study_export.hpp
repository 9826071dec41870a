#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "session/folder/session_folder.hpp"
#include "session/scoring/export_table.hpp"
#include "study/study.hpp"

namespace ream::study {

/// What leaves a study: no names, no ids of users or sessions, no dates; of time only the day since the
/// participant's first session.
struct StudyExport {
  session::ExportTable sessions;  ///< a row a session, by participant and attempt
  session::ExportTable answers;   ///< a row a participant
  session::ExportTable groups;    ///< a row an experience level and figure: n, median, quartiles
  session::ExportTable ratings;   ///< a row a rater and session
};

/// A rater's answers about one session.
struct SessionRating {
  std::string rater, session;
  nlohmann::json answers;
};

/// What metrics.json says of a session, by its id.
using MetricsOfSession = std::function<nlohmann::json(const std::string&)>;

/// Sessions of participants that are not in the list are left out. Dates of sessions are used for order and
/// day only.
StudyExport export_of(const Study& study, const std::vector<Participant>& participants,
                      const std::vector<session::SessionRecord>& sessions, const MetricsOfSession& metrics,
                      const std::vector<SessionRating>& ratings = {});

/// What the columns of all tables mean.
nlohmann::json codebook_of(const Study& study, const StudyExport& all);

}  // namespace ream::study
