#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "session/scoring/export_table.hpp"
#include "statistics/estimate.hpp"
#include "store/feel_table.hpp"
#include "study/study.hpp"

namespace ream::study {

/// What surgeons did in a published study. Their task was not a choice between two, so chance is not 0.5.
struct PublishedShare {
  double share = 0.0, sd = 0.0;
  const char* source = "";
};

/// How often participants were right in one comparison. Numbers are over those who have answered all of its
/// trials.
struct FeelLine {
  const case_::PlateComparison* comparison = nullptr;
  size_t persons = 0, answers = 0;
  std::optional<double> right;                   ///< mean over persons of the share of right answers
  std::optional<double> sd;                      ///< between persons
  std::optional<statistics::Interval> interval;  ///< of the mean, 95 %, by t; `note` says where it is not
  std::optional<double> chance_p;                ///< two-sided, of the mean against 0.5, t test over persons
  std::optional<double> chance_p_holm;           ///< adjusted for all comparisons of the study
  std::optional<double> d_prime;                 ///< sqrt(2) z(mean) (Macmillan & Creelman 2005, ch. 7)
  std::string note;                              ///< why numbers are missing
  std::optional<PublishedShare> published;
};

struct FeelReport {
  std::vector<FeelLine> lines;
  size_t participants = 0;  ///< who have answered at least once
};

/// Answers of codes that the study does not know are left out.
FeelReport feel_report(const Study& study, const std::vector<Participant>& participants,
                       const std::vector<store::FeelAnswerRow>& answers);

nlohmann::json to_json(const FeelReport& report);

/// A row an answer: participant, experience, trial, comparison, what was right, what was chosen.
session::ExportTable feel_answer_table(const Study& study, const std::vector<Participant>& participants,
                                       const std::vector<store::FeelAnswerRow>& answers);

}  // namespace ream::study
