#pragma once
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "net/message.hpp"
#include "store/feel_table.hpp"
#include "study/feel_report.hpp"
#include "study/study_service.hpp"

namespace ream::study {

/// Where a participant of a study of feel is.
struct FeelPlace {
  std::optional<FeelTrial> trial;  ///< none: all are answered
  std::string session;             ///< in which its plates were felt; empty: that comes first
};

/// Trials of studies of feel: two plates are felt in a session, then which of them was asked for is answered,
/// for good. Nobody learns what was right while the study is open but operators. Thread-safe; errors as those
/// of StudyService, and conflict for a study of another kind.
class FeelService {
 public:
  /// `studies` outlives it.
  FeelService(store::Database& database, const StudyService& studies,
              std::shared_ptr<const StudyDependencies> dependencies)
      : table_(database), studies_(studies), dependencies_(std::move(dependencies)) {}

  /// Of the caller, or of whom staff names.
  FeelPlace place(const net::Caller& caller, const std::string& study, const std::string& code) const;
  /// Answers trial `number`, which must be the one at place(), with "upper" or "lower"; where the participant
  /// is then. Error conflict before both of its plates were touched, and while a session goes on;
  /// RequestError 403 for another's who has an account.
  FeelPlace answer(const net::Caller& caller, const std::string& study, const std::string& code, int number,
                   const std::string& chosen);

  /// Whether what a session measured is to be hidden from the caller: it tells what the plates are made of.
  bool hides(const net::Caller& caller, const session::SessionRequest& session) const;

  /// For operators; for others once the study is closed.
  FeelReport report(const net::Caller& caller, const std::string& study) const;
  session::ExportTable answers(const net::Caller& caller, const std::string& study) const;

 private:
  Study study_of_feel(const net::Caller& caller, const std::string& id) const;
  /// The latest session on the trial's plates after that of the last answer.
  std::string session_of(const Study& study, const FeelTrial& trial, const std::string& code,
                         const std::vector<store::FeelAnswerRow>& own) const;

  store::FeelTable table_;
  const StudyService& studies_;
  const std::shared_ptr<const StudyDependencies> dependencies_;
};

}  // namespace ream::study
