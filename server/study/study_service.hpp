#pragma once
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "net/message.hpp"
#include "store/feel_table.hpp"
#include "store/rating_table.hpp"
#include "store/study_table.hpp"
#include "study/blinding.hpp"
#include "study/study_export.hpp"
#include "study/validity_report.hpp"

namespace ream::study {

/// What a study is made of.
struct StudyDraft {
  std::string name, description;
  StudySettings settings;
  std::optional<Questionnaire> questionnaire;
};

/// Who is to take part. Both empty: nobody says who it is.
struct NewParticipant {
  std::string experience;
  int64_t procedures_done = 0;
  std::string user_id;    ///< of somebody with an account
  std::string name;       ///< for operators, of somebody without
  std::string join_code;  ///< of who enrols themself
};

/// Somebody with an account.
struct StudyUser {
  std::string name, role;
};

/// What studies ask of the rest of the server. Thread-safe.
class StudyDependencies {
 public:
  virtual ~StudyDependencies() = default;
  /// None for an unknown id.
  virtual std::optional<StudyUser> find_user(const std::string& user_id) const = 0;
  virtual bool has_case(const std::string& case_id) const = 0;
  /// Whether the participant has a session of the study that has not ended.
  virtual bool has_live_session(const std::string& study_id, const std::string& code) const = 0;
  /// All sessions of a study that have run and ended.
  virtual std::vector<session::SessionRecord> sessions(const std::string& study_id) const = 0;
  /// What metrics.json says of one; an empty object where it left none.
  virtual nlohmann::json metrics(const std::string& session_id) const = 0;
};

/// Studies and who takes part in them. Who a participant is stays hidden from all but operators and the
/// person until the study is closed and unblinded. Thread-safe. Errors: not_found for what a caller may not
/// know of too; conflict when the study's state does not allow it; those of the database.
class StudyService {
 public:
  StudyService(store::Database& database, std::shared_ptr<const StudyDependencies> dependencies);

  Study create(const StudyDraft& draft);
  /// Newest first; trainees have those they take part in.
  std::vector<Study> list(const net::Caller& caller) const;
  Study get(const net::Caller& caller, const std::string& id) const;
  /// Only name and description once somebody takes part.
  Study change(const std::string& id, const StudyDraft& draft);
  Study close(const std::string& id);
  /// Whether it is there and closed.
  bool is_closed(const std::string& id) const;
  /// Goes on with one that was closed and not unblinded.
  Study reopen(const std::string& id);
  /// Shows who the participants are, for good. Only of a closed one.
  Study unblind(const std::string& id);
  /// Only of one that nobody takes part in.
  void remove(const std::string& id);

  /// Only operators may say who it is; others enrol a person by giving them the join code.
  Participant enrol(const net::Caller& caller, const std::string& id, const NewParticipant& wanted);
  /// The caller takes part in the open study with this join code; its id and the participant.
  std::pair<std::string, Participant> join(const net::Caller& caller, const NewParticipant& about);
  /// By code. While a study is open only operators learn what else is known of a participant than the code,
  /// so that who scores does not know who is how experienced.
  std::vector<Participant> participants(const net::Caller& caller, const std::string& id) const;
  /// Codes of all who take part.
  std::set<std::string> codes(const std::string& id) const;
  /// How many take part.
  int64_t count(const std::string& id) const { return table_.count(id); }
  /// Trainees have themselves only; of others only the code is told as in the list.
  Participant participant(const net::Caller& caller, const std::string& id, const std::string& code) const;
  /// Who takes part, for operators; for others once it is unblinded.
  std::vector<store::PersonRow> persons(const net::Caller& caller, const std::string& id) const;
  /// The caller's code; empty when they do not take part.
  std::string code_of(const net::Caller& caller, const std::string& id) const;
  /// The participant's own, or, of one without an account, by whoever runs the study. RequestError 422 names
  /// what is wrong with them, 403 when they are somebody else's.
  Participant answer(const net::Caller& caller, const std::string& id, const std::string& code,
                     const nlohmann::json& answers);
  /// Forgets a participant: person, answers, and their rows in exports.
  void withdraw(const std::string& id, const std::string& code);

  /// For operators; for others once the study is closed.
  StudyExport export_all(const net::Caller& caller, const std::string& id) const;
  /// What of the study shows whether scores mean anything; who may have it as export_all().
  ValidityInput validity_input(const net::Caller& caller, const std::string& id) const;
  /// All participants with everything; who may have it as export_all().
  std::vector<Participant> everybody_for_export(const net::Caller& caller, const std::string& id) const;
  /// What the columns of the export mean.
  nlohmann::json codebook(const std::string& id) const;

  /// Makes a wanted session one of the study that it names: checks that it may be, fills in the participant
  /// and the study's settings. `wanted.participant` empty: the caller.
  void admit(const net::Caller& caller, session::SessionRequest& wanted) const;
  /// What the participant does next by the study's design; none when all is done, or without a design.
  std::optional<NextSession> next(const Study& study, const std::string& code) const;
  /// The trial of a study of feel that the participant does next; none when all are answered, or in a study
  /// of another kind.
  std::optional<FeelTrial> next_feel_trial(const Study& study, const std::string& code) const;
  /// Ids of the open studies whose sessions the caller rates.
  std::vector<std::string> rated_by(const net::Caller& caller) const;
  /// Error conflict unless a session of a study may be begun anew from intact bone, or be gone on with: a
  /// test is done once, and training ends with its sessions.
  void require_repeatable(const session::SessionRequest& session) const;
  /// What the caller may know of who trained.
  Blinding blinding(const net::Caller& caller) const;

 private:
  Study known(const std::string& id) const;
  Study open_one(const std::string& id) const;
  void require_export(const net::Caller& caller, const Study& study) const;
  std::vector<Participant> everybody(const std::string& id) const;
  std::vector<SessionRating> ratings_of(const std::string& id) const;
  StudyExport everything(const Study& study) const;
  Participant add_participant(const Study& study, const NewParticipant& wanted,
                              const std::optional<store::PersonRow>& person);
  void require_settings(const StudySettings& settings) const;
  /// Who rates blind runs no sessions and enrols nobody.
  void require_no_rater(const net::Caller& caller, const std::string& id) const;
  /// Makes a session of a study with a design what the participant does next.
  void place_in_design(const Study& study, session::SessionRequest& wanted) const;
  /// Makes a session of a study of feel that on the plates of the participant's next trial.
  void place_in_feel(const Study& study, session::SessionRequest& wanted) const;
  void require_no_live_session(const Study& study, const std::string& code) const;

  mutable store::StudyTable table_;
  store::RatingTable ratings_;
  store::FeelTable feel_answers_;
  const std::shared_ptr<const StudyDependencies> dependencies_;
};

}  // namespace ream::study
