#include "study/rating_service.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "access/role.hpp"
#include "access/secret.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "study/study_sessions.hpp"

namespace ream::study {
using nlohmann::json;
namespace {

/// A session's name for one rater. Who has no rating_key cannot work it out, nor tell which session it is of.
std::string key_of(const Study& study, const std::string& label, const std::string& session) {
  return access::keyed_digest(study.rating_key, label + "/" + session);
}

bool is_rated(const Study& study, const session::SessionRecord& session) {
  if (!carried_out(session)) return false;
  if (!study.settings.design) return true;
  const auto phase = phase_from(session.request.phase);
  return phase && is_test(*phase);
}

const Questionnaire& form_of(const Study& study) {
  if (!study.settings.rating_form)
    throw Error(ErrorKind::conflict, "study '" + study.id + "' has no form for raters");
  return *study.settings.rating_form;
}

}  // namespace

Rater RatingService::add(const net::Caller& caller, const std::string& study_id, const std::string& user_id) {
  const Study study = studies_.get(caller, study_id);
  form_of(study);
  if (!study.open)
    throw Error(ErrorKind::conflict, "study '" + study_id + "' is closed; nobody rates it any more");
  const auto user = dependencies_->find_user(user_id);
  if (!user) throw Error(ErrorKind::not_found, "no user '" + user_id + "'");
  if (access::is_operator(user->role))
    throw Error(ErrorKind::conflict,
                user->name + " is an operator and sees who takes part; only instructors rate blind");
  if (!access::is_staff(user->role))
    throw Error(ErrorKind::conflict, user->name + " is no instructor; only instructors rate");
  for (const store::RaterRow& rater : table_.raters(study_id))
    if (rater.user_id == user_id)
      throw Error(ErrorKind::conflict, user->name + " rates study '" + study_id + "' already");
  const std::string label = table_.add_rater(study_id, user_id, user->name);
  const store::RaterRow row{label, user_id, user->name};
  return {label, user_id, user->name, 0, static_cast<int64_t>(queue_of(study, row, rateable(study)).size())};
}

void RatingService::remove(const std::string& study, const std::string& label) {
  if (studies_.is_closed(study))
    throw Error(ErrorKind::conflict, "study '" + study + "' is closed; its raters and ratings stay");
  table_.remove_rater(study, label);
}

std::vector<Rater> RatingService::raters(const net::Caller& caller, const std::string& study_id) const {
  const Study study = studies_.get(caller, study_id);
  const std::vector<session::SessionRecord> sessions = rateable(study);
  std::vector<Rater> list;
  for (const store::RaterRow& row : table_.raters(study_id)) {
    const std::vector<QueuedRating> queue = queue_of(study, row, sessions);
    const auto rated =
        std::count_if(queue.begin(), queue.end(), [](const auto& one) { return one.answers.has_value(); });
    list.push_back({row.label, row.user_id, row.name, rated, static_cast<int64_t>(queue.size())});
  }
  return list;
}

std::vector<session::SessionRecord> RatingService::rateable(const Study& study) const {
  const std::set<std::string> codes = studies_.codes(study.id);
  std::vector<session::SessionRecord> all = dependencies_->sessions(study.id);
  std::erase_if(all, [&](const session::SessionRecord& session) {
    return !codes.contains(session.request.participant) || !is_rated(study, session) ||
           !touched_bone(dependencies_->metrics(session.request.id));
  });
  return all;
}

std::vector<QueuedRating> RatingService::queue_of(const Study& study, const store::RaterRow& rater,
                                                  const std::vector<session::SessionRecord>& sessions) const {
  std::map<std::string, std::string> answers;
  for (const store::RatingRow& row : table_.ratings(study.id))
    if (row.rater == rater.label) answers[row.session] = row.answers;
  std::vector<QueuedRating> queue;
  for (const session::SessionRecord& session : sessions) {
    if (!rater.user_id.empty() && session.request.trainee_id == rater.user_id) continue;
    const std::string& id = session.request.id;
    const auto given = answers.find(id);
    queue.push_back({key_of(study, rater.label, id), id,
                     given == answers.end() ? std::nullopt : std::optional(parse_json(given->second))});
  }
  std::sort(queue.begin(), queue.end(), [](const auto& a, const auto& b) { return a.key < b.key; });
  return queue;
}

store::RaterRow RatingService::rater_of(const net::Caller& caller, const std::string& study) const {
  for (const store::RaterRow& rater : table_.raters(study))
    if (!caller.user_id.empty() && rater.user_id == caller.user_id) return rater;
  throw Error(ErrorKind::not_found, "you do not rate study '" + study + "'");
}

std::vector<QueuedRating> RatingService::queue(const net::Caller& caller, const std::string& study_id) const {
  const Study study = studies_.get(caller, study_id);
  return queue_of(study, rater_of(caller, study_id), rateable(study));
}

QueuedRating RatingService::queued(const net::Caller& caller, const std::string& study,
                                   const std::string& key) const {
  for (QueuedRating& one : queue(caller, study))
    if (one.key == key) return one;
  throw Error(ErrorKind::not_found, "no session '" + key + "' in your rating queue of study '" + study + "'");
}

void RatingService::rate(const net::Caller& caller, const std::string& study_id, const std::string& key,
                         const json& answers) {
  const Study study = studies_.get(caller, study_id);
  const store::RaterRow rater = rater_of(caller, study_id);
  const QueuedRating one = queued(caller, study_id, key);
  if (!study.open)
    throw Error(ErrorKind::conflict, "study '" + study_id + "' is closed; ratings can no longer change");
  if (const auto faults = faults_of_answers(form_of(study), answers); !faults.empty())
    throw net::RequestError(422, "the rating cannot be used: " + faults.front().detail, faults);
  table_.set(study_id, {rater.label, one.session, answers.dump()});
}

bool RatingService::rates(const net::Caller& caller, const std::string& study) const {
  return !caller.user_id.empty() && table_.labels_of(caller.user_id).contains(study);
}

bool RatingService::hides(const net::Caller& caller, const session::SessionRequest& session) const {
  if (session.study.empty() || !rates(caller, session.study)) return false;
  return studies_.blinding(caller).hides_all(session);
}

}  // namespace ream::study
