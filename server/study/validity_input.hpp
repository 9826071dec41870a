#pragma once
#include <string_view>
#include <vector>

#include "study/study_export.hpp"
#include "study/validity_report.hpp"

namespace ream::study {

/// A study's sessions and ratings as the validity report takes them: sessions that were carried out and
/// touched bone, under codes as "K7-F3M-2", the participant's second; tests beyond those of the design left
/// out; of their measures the points, where all are by one rubric, and those metrics of the catalogue that
/// the plan does not fix; of ratings the items of five points and, as 1 and 0, choices between two, whose
/// first option counts as done.
ValidityInput validity_input_of(const Study& study, const std::vector<Participant>& participants,
                                const std::vector<session::SessionRecord>& sessions,
                                const MetricsOfSession& metrics, const std::vector<SessionRating>& ratings);

/// proto/analysis/validity.R, which computes the report's numbers again.
std::string_view validity_script();

}  // namespace ream::study
