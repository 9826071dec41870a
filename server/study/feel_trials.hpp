#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "case/two_plates.hpp"

namespace ream::study {

/// What the sessions of a study of feel are for, as the design's phases say it of others.
inline constexpr const char* feel_phase = "feel";

/// What each participant of a study of feel is asked.
struct FeelTrials {
  std::vector<std::string> comparisons;  ///< ids of case_::plate_comparisons(), all different
  int trials_per_comparison = 8;         ///< even: the right answer is as often the upper plate as the lower
};

/// Every key written out. from: as openapi.yaml has it, all comparisons where none are named; Error
/// invalid_input for one that comes twice.
nlohmann::json to_json(const FeelTrials& trials);
FeelTrials feel_trials_from(const nlohmann::json& value);

/// One forced choice between two plates.
struct FeelTrial {
  int number = 1, of = 1;
  const case_::PlateComparison* comparison = nullptr;
  bool asked_for_is_upper = false;

  std::string case_id() const { return case_::two_plates_id(comparison->id, asked_for_is_upper); }
  const char* right_answer() const { return asked_for_is_upper ? "upper" : "lower"; }
};

/// All of one participant, in a random order that is theirs alone. The same seed and code give the same order
/// on every machine.
std::vector<FeelTrial> trials_for(const FeelTrials& trials, const std::string& seed, const std::string& code);

}  // namespace ream::study
