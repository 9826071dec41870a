#include "session/scoring/ended_sessions.hpp"

#include <algorithm>

#include "case/two_plates.hpp"
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

std::vector<EndedSession> ended_sessions(const std::filesystem::path& data) {
  const SessionArchive archive(sessions_folder(data));
  std::vector<EndedSession> sessions;
  for (const SessionRecord& record : archive.list()) try {
      if (is_live(record.status.state)) continue;
      const std::filesystem::path folder = archive.folder_of(record.request.id);
      sessions.push_back({record.request.id, read_json_file(session_json(folder)), {}, folder});
    } catch (const Error& e) {
      log::warn(e.what());
    }
  std::stable_sort(sessions.begin(), sessions.end(), [](const EndedSession& a, const EndedSession& b) {
    const std::string a_utc = a.session.value("created_utc", ""), b_utc = b.session.value("created_utc", "");
    return a_utc != b_utc ? a_utc < b_utc : a.id < b.id;
  });
  return sessions;
}

std::vector<EndedSession> sessions_of_trainee(const std::vector<EndedSession>& sessions,
                                              const std::string& trainee) {
  std::vector<EndedSession> theirs;
  if (trainee.empty()) return theirs;
  for (const EndedSession& session : sessions)
    if (goes_by(session.session, trainee)) theirs.push_back(session);
  return theirs;
}

std::string trainee_of(const nlohmann::json& session) {
  for (const char* key : {"trainee_id", "participant", "trainee"})
    if (const std::string word = session.value(key, ""); !word.empty()) return word;
  return "";
}

bool is_attempt(const EndedSession& session) {
  return session.session.value("device", "script") != "script" &&
         !case_::is_two_plates(session.session.value("case", "")) &&
         session.value("removed_volume_mm3") != std::optional(0.0);
}

score::LearningPoint learning_point(const EndedSession& session, const score::Score& score) {
  score::LearningPoint point;
  point.session = session.id;
  point.created_utc = session.session.value("created_utc", "");
  point.theatre = session.session.value("theatre", false);
  point.points = score.points;
  point.outcome = score.outcome;
  return point;
}

score::LearningCurve learning_of(const std::vector<EndedSession>& sessions, const score::Rubric& rubric,
                                 const score::CusumParameters& parameters) {
  std::vector<score::LearningPoint> points;
  for (const EndedSession& session : sessions) {
    std::error_code failed;
    if (!std::filesystem::exists(metrics_json(session.folder), failed)) continue;
    EndedSession read = session;
    read.metrics = read_json_file(metrics_json(session.folder));
    if (is_attempt(read)) points.push_back(learning_point(read, score::apply_rubric(rubric, read.metrics)));
  }
  return score::learning_curve(parameters, std::move(points));
}

}  // namespace ream::session
