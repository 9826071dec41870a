#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "study/feel_trials.hpp"
#include "study/questionnaire.hpp"
#include "study/study_design.hpp"

namespace ream::study {

/// What every session of a study is, so that they can be compared.
struct StudySettings {
  std::vector<std::string> cases;                 ///< ids; a session is on one of them
  std::string script;                             ///< empty: the usual one of the device
  std::string device;                             ///< empty: the server's usual one
  std::string device_profile;                     ///< empty: the device's usual one
  std::optional<StudyDesign> design = {};         ///< none: sessions in any number and order
  std::optional<Questionnaire> rating_form = {};  ///< what raters fill in about a session; none: nobody rates
  /// A study of feel: it has neither cases nor design nor raters.
  std::optional<FeelTrials> feel = {};
};

/// Sessions of several people, compared by what they did and said; nobody who compares knows who they are.
struct Study {
  std::string id, name, description;
  bool open = true;  ///< sessions, participants and answers come in
  std::string join_code;
  std::string allocation_seed;  ///< of the random sequence of arms; hidden until the study is closed
  std::string rating_key;       ///< names sessions for raters; nobody sees it
  StudySettings settings;
  std::optional<Questionnaire> questionnaire;
  std::string created_utc, closed_utc, unblinded_utc;  ///< the latter two empty until it is

  /// Whether persons are hidden from all but operators and themselves.
  bool blinded() const { return unblinded_utc.empty(); }
};

/// Words for how much somebody has done of the real thing, from least to most.
inline const std::vector<std::string> experience_levels = {"novice", "intermediate", "expert"};

struct Participant {
  std::string code;        ///< "K7-F3M": drawn at random, says nothing about the person
  std::string experience;  ///< of experience_levels
  int64_t procedures_done = 0;
  std::optional<nlohmann::json> answers;  ///< by item id; none yet
  bool has_account = false;               ///< logs in, and so answers without help
  std::string arm = {};                   ///< id of one of the design's; empty: the study has none
};

}  // namespace ream::study
