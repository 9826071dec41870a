#include "store/feel_table.hpp"

#include <algorithm>
#include <iterator>

#include "core/error.hpp"
#include "store/sql.hpp"

namespace ream::store {

void FeelTable::add(const std::string& study, const FeelAnswerRow& answer) {
  database_.run([&](Sql& sql) {
    const long long trial = answer.trial;
    int count = 0;
    sql << "SELECT COUNT(*) FROM studies WHERE id = :study AND state = 'open'", use(study), into(count);
    if (count == 0)
      throw Error(ErrorKind::conflict, "study '" + study + "' is closed; nothing more can be added to it");
    sql << "SELECT COUNT(*) FROM study_participants WHERE study = :study AND code = :code", use(study),
        use(answer.participant), into(count);
    if (count == 0)
      throw Error(ErrorKind::not_found,
                  "no participant '" + answer.participant + "' in study '" + study + "'");
    sql << "SELECT COUNT(*) FROM study_feel_answers WHERE study = :study AND participant = :code AND trial = "
           ":trial",
        use(study), use(answer.participant), use(trial), into(count);
    if (count > 0)
      throw Error(ErrorKind::conflict, "participant '" + answer.participant + "' has answered trial " +
                                           std::to_string(answer.trial));
    sql << "INSERT INTO study_feel_answers (study, participant, trial, chosen, session, answered_utc) VALUES "
           "(:study, :participant, :trial, :chosen, :session, :answered_utc)",
        use(study), use(answer.participant), use(trial), use(answer.chosen), use(answer.session),
        use(answer.answered_utc);
  });
}

std::vector<FeelAnswerRow> FeelTable::answers(const std::string& study) const {
  return database_.read([&](Sql& sql) {
    std::vector<FeelAnswerRow> found;
    FeelAnswerRow row;
    long long trial = 0;
    for_each_row((sql.prepare << "SELECT participant, trial, chosen, session, answered_utc FROM "
                                 "study_feel_answers WHERE study = :study ORDER BY participant, trial",
                  use(study), into(row.participant), into(trial), into(row.chosen), into(row.session),
                  into(row.answered_utc)),
                 [&] {
                   row.trial = trial;
                   found.push_back(row);
                 });
    return found;
  });
}

std::vector<FeelAnswerRow> answers_of(const std::vector<FeelAnswerRow>& answers, const std::string& code) {
  std::vector<FeelAnswerRow> own;
  std::copy_if(answers.begin(), answers.end(), std::back_inserter(own),
               [&](const FeelAnswerRow& answer) { return answer.participant == code; });
  return own;
}

}  // namespace ream::store
