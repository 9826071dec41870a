#include "store/study_table.hpp"

#include "core/error.hpp"
#include "store/sql.hpp"

namespace ream::store {
namespace {

constexpr const char* study_columns =
    "SELECT id, name, description, state, join_code, settings, questionnaire, created_utc, closed_utc, "
    "unblinded_utc FROM studies ";

void require_known(bool known, const std::string& what) {
  if (!known) throw Error(ErrorKind::not_found, what);
}

bool study_exists(Sql& sql, const std::string& id) {
  int count = 0;
  sql << "SELECT COUNT(*) FROM studies WHERE id = :id", use(id), into(count);
  return count > 0;
}

bool participant_exists(Sql& sql, const std::string& study, const std::string& code) {
  int count = 0;
  sql << "SELECT COUNT(*) FROM study_participants WHERE study = :study AND code = :code", use(study),
      use(code), into(count);
  return count > 0;
}

/// The first study of `where`, whose one parameter is `value`.
std::optional<StudyRow> study_where(Sql& sql, const std::string& where, const std::string& value) {
  StudyRow row;
  sql << study_columns + where, use(value), into(row.id), into(row.name), into(row.description),
      into(row.state), into(row.join_code), into(row.settings), into(row.questionnaire),
      into(row.created_utc), into(row.closed_utc), into(row.unblinded_utc);
  return sql.got_data() ? std::optional(row) : std::nullopt;
}

/// The first place of the sequence that nobody has ever had; two who take the same one at once are told apart
/// by the primary key, and the later of them is refused.
int64_t take_place(Sql& sql, const std::string& study, const std::string& stratum) {
  long long place = 0;
  sql << "SELECT COUNT(*) FROM study_allocations WHERE study = :study AND stratum = :stratum", use(study),
      use(stratum), into(place);
  sql << "INSERT INTO study_allocations (study, stratum, place) VALUES (:study, :stratum, :place)",
      use(study), use(stratum), use(place);
  return place;
}

std::string unknown_participant(const std::string& study, const std::string& code) {
  return "no participant '" + code + "' in study '" + study + "'";
}

}  // namespace

void StudyTable::add(const StudyRow& study) {
  database_.run([&](Sql& sql) {
    sql << "INSERT INTO studies (id, name, description, state, join_code, settings, questionnaire, "
           "created_utc, closed_utc, unblinded_utc) VALUES (:id, :name, :description, :state, :join_code, "
           ":settings, :questionnaire, :created_utc, :closed_utc, :unblinded_utc)",
        use(study.id), use(study.name), use(study.description), use(study.state), use(study.join_code),
        use(study.settings), use(study.questionnaire), use(study.created_utc), use(study.closed_utc),
        use(study.unblinded_utc);
  });
}

void StudyTable::replace(const StudyRow& study) {
  database_.run([&](Sql& sql) {
    require_known(study_exists(sql, study.id), "no study '" + study.id + "'");
    sql << "UPDATE studies SET name = :name, description = :description, state = :state, "
           "join_code = :join_code, settings = :settings, questionnaire = :questionnaire, "
           "closed_utc = :closed_utc, unblinded_utc = :unblinded_utc WHERE id = :id",
        use(study.name), use(study.description), use(study.state), use(study.join_code), use(study.settings),
        use(study.questionnaire), use(study.closed_utc), use(study.unblinded_utc), use(study.id);
  });
}

void StudyTable::remove(const std::string& id) {
  database_.run([&](Sql& sql) {
    require_known(study_exists(sql, id), "no study '" + id + "'");
    for (const char* table : {"study_ratings", "study_raters", "study_allocations", "study_feel_answers"})
      sql << "DELETE FROM " + std::string(table) + " WHERE study = :id", use(id);
    sql << "DELETE FROM studies WHERE id = :id", use(id);
  });
}

std::optional<StudyRow> StudyTable::find(const std::string& id) const {
  return database_.read([&](Sql& sql) { return study_where(sql, "WHERE id = :id", id); });
}

std::optional<StudyRow> StudyTable::find_by_join_code(const std::string& join_code) const {
  return database_.read(
      [&](Sql& sql) { return study_where(sql, "WHERE join_code = :join_code", join_code); });
}

std::vector<StudyRow> StudyTable::list() const {
  return database_.read([](Sql& sql) {
    std::vector<StudyRow> found;
    StudyRow row;
    for_each_row(
        (sql.prepare << std::string(study_columns) + "ORDER BY created_utc DESC, id", into(row.id),
         into(row.name), into(row.description), into(row.state), into(row.join_code), into(row.settings),
         into(row.questionnaire), into(row.created_utc), into(row.closed_utc), into(row.unblinded_utc)),
        [&] { found.push_back(row); });
    return found;
  });
}

std::string StudyTable::enrol(ParticipantRow participant, const std::optional<PersonRow>& person,
                              const std::string& stratum, const std::function<std::string(int64_t)>& arm_at) {
  return database_.run([&](Sql& sql) {
    require_known(study_exists(sql, participant.study), "no study '" + participant.study + "'");
    if (arm_at) participant.arm = arm_at(take_place(sql, participant.study, stratum));
    const long long procedures_done = participant.procedures_done;
    sql << "INSERT INTO study_participants (code, study, experience, procedures_done, answers, arm) VALUES "
           "(:code, :study, :experience, :procedures_done, :answers, :arm)",
        use(participant.code), use(participant.study), use(participant.experience), use(procedures_done),
        use(participant.answers), use(participant.arm);
    if (person)
      sql << "INSERT INTO study_persons (code, study, user_id, name) VALUES (:code, :study, :user_id, :name)",
          use(person->code), use(participant.study), use(person->user_id), use(person->name);
    return participant.arm;
  });
}

void StudyTable::set_answers(const std::string& study, const std::string& code, const std::string& answers) {
  database_.run([&](Sql& sql) {
    require_known(participant_exists(sql, study, code), unknown_participant(study, code));
    sql << "UPDATE study_participants SET answers = :answers WHERE code = :code", use(answers), use(code);
  });
}

void StudyTable::remove_participant(const std::string& study, const std::string& code) {
  database_.run([&](Sql& sql) {
    require_known(participant_exists(sql, study, code), unknown_participant(study, code));
    sql << "DELETE FROM study_persons WHERE code = :code", use(code);
    sql << "DELETE FROM study_feel_answers WHERE participant = :code", use(code);
    sql << "DELETE FROM study_participants WHERE code = :code", use(code);
  });
}

std::optional<ParticipantRow> StudyTable::participant(const std::string& study,
                                                      const std::string& code) const {
  return database_.read([&](Sql& sql) -> std::optional<ParticipantRow> {
    ParticipantRow row;
    long long procedures_done = 0;
    sql << "SELECT code, study, experience, procedures_done, answers, arm FROM study_participants "
           "WHERE study = :study AND code = :code",
        use(study), use(code), into(row.code), into(row.study), into(row.experience), into(procedures_done),
        into(row.answers), into(row.arm);
    if (!sql.got_data()) return std::nullopt;
    row.procedures_done = procedures_done;
    return row;
  });
}

std::vector<ParticipantRow> StudyTable::participants(const std::string& study) const {
  return database_.read([&](Sql& sql) {
    std::vector<ParticipantRow> found;
    ParticipantRow row;
    long long procedures_done = 0;
    for_each_row((sql.prepare << "SELECT code, study, experience, procedures_done, answers, arm FROM "
                                 "study_participants WHERE study = :study ORDER BY code",
                  use(study), into(row.code), into(row.study), into(row.experience), into(procedures_done),
                  into(row.answers), into(row.arm)),
                 [&] {
                   row.procedures_done = procedures_done;
                   found.push_back(row);
                 });
    return found;
  });
}

int64_t StudyTable::count(const std::string& study) const {
  return database_.read([&](Sql& sql) {
    long long count = 0;
    sql << "SELECT COUNT(*) FROM study_participants WHERE study = :study", use(study), into(count);
    return count;
  });
}

std::vector<PersonRow> StudyTable::persons(const std::string& study) const {
  return database_.read([&](Sql& sql) {
    std::vector<PersonRow> found;
    PersonRow row;
    for_each_row(
        (sql.prepare << "SELECT code, user_id, name FROM study_persons WHERE study = :study ORDER BY code",
         use(study), into(row.code), into(row.user_id), into(row.name)),
        [&] { found.push_back(row); });
    return found;
  });
}

std::optional<PersonRow> StudyTable::person(const std::string& study, const std::string& code) const {
  return database_.read([&](Sql& sql) -> std::optional<PersonRow> {
    PersonRow row;
    sql << "SELECT code, user_id, name FROM study_persons WHERE study = :study AND code = :code", use(study),
        use(code), into(row.code), into(row.user_id), into(row.name);
    return sql.got_data() ? std::optional(row) : std::nullopt;
  });
}

std::string StudyTable::code_of(const std::string& study, const std::string& user_id) const {
  const std::map<std::string, std::string> codes = codes_of(user_id);
  const auto found = codes.find(study);
  return found == codes.end() ? std::string() : found->second;
}

void StudyTable::forget_person(const std::string& user_id) {
  database_.run([&](Sql& sql) { sql << "DELETE FROM study_persons WHERE user_id = :user_id", use(user_id); });
}

std::map<std::string, std::string> StudyTable::codes_of(const std::string& user_id) const {
  if (user_id.empty()) return {};
  return database_.read([&](Sql& sql) {
    std::map<std::string, std::string> found;
    std::string study, code;
    for_each_row((sql.prepare << "SELECT study, code FROM study_persons WHERE user_id = :user_id",
                  use(user_id), into(study), into(code)),
                 [&] { found[study] = code; });
    return found;
  });
}

}  // namespace ream::store
