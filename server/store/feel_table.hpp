#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "store/database.hpp"

namespace ream::store {

/// What a participant of a study of feel chose in one trial.
struct FeelAnswerRow {
  std::string participant;   ///< code
  int64_t trial = 0;         ///< from 1
  std::string chosen;        ///< "upper" or "lower"
  std::string session;       ///< in which the plates were felt
  std::string answered_utc;  ///< "2026-01-31T12:00:00.250Z"
};

/// Thread-safe; errors are those of Database.
class FeelTable {
 public:
  explicit FeelTable(Database& database) : database_(database) {}

  /// Error conflict when the trial has an answer or the study is closed, not_found without the participant.
  void add(const std::string& study, const FeelAnswerRow& answer);
  /// Of everybody, by participant, then trial.
  std::vector<FeelAnswerRow> answers(const std::string& study) const;

 private:
  Database& database_;
};

/// Those of one participant, in the order of trials.
std::vector<FeelAnswerRow> answers_of(const std::vector<FeelAnswerRow>& answers, const std::string& code);

}  // namespace ream::store
