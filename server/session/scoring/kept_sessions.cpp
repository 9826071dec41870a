#include "session/scoring/kept_sessions.hpp"

#include <algorithm>

#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "session/folder/session_archive.hpp"
#include "session/folder/session_folder.hpp"

namespace ream::session {
namespace {

bool goes_by(const nlohmann::json& session, const std::string& trainee) {
  for (const char* key : {"trainee_id", "participant", "trainee"})
    if (session.value(key, "") == trainee) return true;
  return false;
}

}  // namespace

std::vector<KeptSession> kept_sessions(const std::filesystem::path& data) {
  const SessionArchive archive(sessions_folder(data));
  std::vector<KeptSession> sessions;
  for (const SessionRecord& record : archive.list()) try {
      if (is_live(record.status.state)) continue;
      const std::filesystem::path folder = archive.folder_of(record.request.id);
      sessions.push_back({record.request.id, folder, read_json_file(session_json(folder))});
    } catch (const Error& e) {
      log::warn(e.what());
    }
  std::stable_sort(sessions.begin(), sessions.end(), [](const KeptSession& a, const KeptSession& b) {
    const std::string a_utc = a.session.value("created_utc", ""), b_utc = b.session.value("created_utc", "");
    return a_utc != b_utc ? a_utc < b_utc : a.id < b.id;
  });
  return sessions;
}

std::vector<KeptSession> sessions_of_trainee(const std::vector<KeptSession>& sessions,
                                             const std::string& trainee) {
  std::vector<KeptSession> theirs;
  if (trainee.empty()) return theirs;
  for (const KeptSession& session : sessions)
    if (goes_by(session.session, trainee)) theirs.push_back(session);
  return theirs;
}

std::string trainee_of(const nlohmann::json& session) {
  for (const char* key : {"trainee_id", "participant", "trainee"})
    if (const std::string word = session.value(key, ""); !word.empty()) return word;
  return "";
}

score::LearningPoint learning_point(const std::string& id, const nlohmann::json& session,
                                    const score::Score& score) {
  score::LearningPoint point;
  point.session = id;
  point.created_utc = session.value("created_utc", "");
  point.theatre = session.value("theatre", false);
  point.points = score.points;
  point.outcome = score.outcome;
  return point;
}

score::LearningCurve learning_of(const std::vector<KeptSession>& sessions, const score::Rubric& rubric,
                                 const score::CusumParameters& parameters) {
  std::vector<score::LearningPoint> points;
  for (const KeptSession& session : sessions) {
    std::error_code failed;
    if (!std::filesystem::exists(metrics_json(session.folder), failed)) continue;
    const score::Score score = score::apply_rubric(rubric, read_json_file(metrics_json(session.folder)));
    points.push_back(learning_point(session.id, session.session, score));
  }
  return score::learning_curve(parameters, std::move(points));
}

}  // namespace ream::session
