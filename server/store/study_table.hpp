#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "store/database.hpp"

namespace ream::store {

/// A study as it is kept; settings and questionnaire are JSON of whoever owns the table.
struct StudyRow {
  std::string id, name, description;
  std::string state;          ///< "open" or "closed"
  std::string join_code;      ///< with which people enrol themselves; unlike that of every other study
  std::string settings;       ///< what its sessions are
  std::string questionnaire;  ///< empty: none
  std::string created_utc;    ///< "2026-01-31T12:00:00Z", as the two below
  std::string closed_utc;     ///< empty: not
  std::string unblinded_utc;  ///< empty: not
};

/// Somebody who takes part, without saying who.
struct ParticipantRow {
  std::string code;  ///< unlike that of every other participant of any study
  std::string study;
  std::string experience;
  int64_t procedures_done = 0;
  std::string answers;   ///< JSON; empty: none yet
  std::string arm = {};  ///< empty: the study has none
};

/// Who a participant is. Kept in a table of its own.
struct PersonRow {
  std::string code;
  std::string user_id;  ///< empty: somebody without an account
  std::string name;     ///< for people; may be empty
};

/// Studies, participants and persons. Thread-safe; errors are those of Database, and not_found where a row
/// that is to be changed is not there.
class StudyTable {
 public:
  explicit StudyTable(Database& database) : database_(database) {}

  /// Error conflict when id or join code is taken.
  void add(const StudyRow& study);
  void replace(const StudyRow& study);
  /// Error conflict while anybody takes part.
  void remove(const std::string& id);
  std::optional<StudyRow> find(const std::string& id) const;
  std::optional<StudyRow> find_by_join_code(const std::string& join_code) const;
  /// Newest first.
  std::vector<StudyRow> list() const;

  /// Adds a participant and, where `person` is given, who that is; both or none. `arm_at` names the arm at a
  /// place of the random sequence, counted from 0; the participant gets the first place of `stratum` that
  /// nobody has ever had, and with it the arm, which is returned. Without `arm_at` no place is taken. Error
  /// conflict when the code is taken or the user takes part already.
  std::string enrol(ParticipantRow participant, const std::optional<PersonRow>& person,
                    const std::string& stratum = {}, const std::function<std::string(int64_t)>& arm_at = {});
  void set_answers(const std::string& study, const std::string& code, const std::string& answers);
  /// With answers and person.
  void remove_participant(const std::string& study, const std::string& code);
  std::optional<ParticipantRow> participant(const std::string& study, const std::string& code) const;
  /// By code, so that the order says nothing about who came first.
  std::vector<ParticipantRow> participants(const std::string& study) const;
  int64_t count(const std::string& study) const;

  /// By code; participants whose person is not known are left out.
  std::vector<PersonRow> persons(const std::string& study) const;
  std::optional<PersonRow> person(const std::string& study, const std::string& code) const;
  /// Empty when the user does not take part.
  std::string code_of(const std::string& study, const std::string& user_id) const;
  /// Study and code of all that the user takes part in.
  std::map<std::string, std::string> codes_of(const std::string& user_id) const;
  /// Nobody knows any more who takes part under the user's codes; what the participants did stays.
  void forget_person(const std::string& user_id);

 private:
  Database& database_;
};

}  // namespace ream::store
