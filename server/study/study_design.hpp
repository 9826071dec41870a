#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ream::study {

/// What a session of a study with a design is for.
enum class Phase { pre, training, post, retention };

/// "pre", "training", "post" or "retention".
const char* to_text(Phase phase);
/// None for any other text.
std::optional<Phase> phase_from(std::string_view text);
/// Measured alike in every arm.
inline bool is_test(Phase phase) { return phase != Phase::training; }

/// One group of a study's participants. Arms differ in how they train, never in how they are tested.
struct StudyArm {
  std::string id;              ///< [a-z][a-z0-9_]*, stable: exports name it
  std::string name;            ///< for people
  int training_sessions = 0;   ///< 0: a control that does not train
  bool theatre = false;        ///< trains with nothing shown but the bone
  std::string script;          ///< of its training; empty: the study's
  std::string device_profile;  ///< of its training; empty: the study's
};

/// What each participant does, in order: tests before, training by arm, tests after, and tests later on.
struct StudyDesign {
  std::vector<StudyArm> arms;  ///< one or more
  int pre_sessions = 1, post_sessions = 1, retention_sessions = 0;
  int retention_after_days = 14;  ///< between the last session before them and the tests of retention
  std::string test_case;          ///< on which all are tested; empty: the study's first
  bool test_theatre = false;      ///< tests show nothing but the bone
};

/// Every key written out. from: as openapi.yaml has it; Error invalid_input names what is wrong.
nlohmann::json to_json(const StudyDesign& design);
StudyDesign design_from(const nlohmann::json& value);

/// None for an id that no arm has.
const StudyArm* find_arm(const StudyDesign& design, const std::string& id);

/// Which arm is at a place (from 0) of the random sequence of a stratum: permuted blocks of random
/// size, in which each arm comes equally often, once to three times. The same seed gives the same sequence on
/// every machine.
const StudyArm& arm_at(const StudyDesign& design, const std::string& seed, const std::string& stratum,
                       int64_t place);

/// A session that counts for the design: one that was carried to its end.
struct DoneSession {
  std::optional<Phase> phase;
  int64_t day = 0;  ///< days since 1970, UTC
};

/// What a participant does next.
struct NextSession {
  Phase phase = Phase::pre;
  int number = 1, of = 1;  ///< the first of three, for instance
  /// Days since 1970 (UTC) from which on it may be done; 0: at once.
  int64_t not_before_day = 0;
};

/// None: all is done. `done` in any order.
std::optional<NextSession> next_session(const StudyDesign& design, const StudyArm& arm,
                                        const std::vector<DoneSession>& done);

}  // namespace ream::study
