#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "score/ended_session.hpp"
#include "score/learning_curve.hpp"

namespace ream::session {

using score::EndedSession;

/// All ended sessions of a data folder that can be read, oldest first. What cannot be read is left out, with
/// a line in the log. Their metrics are not read.
std::vector<EndedSession> ended_sessions(const std::filesystem::path& data);

/// Those of a trainee: the user of that id, or whoever goes by that name or code.
std::vector<EndedSession> sessions_of_trainee(const std::vector<EndedSession>& sessions,
                                              const std::string& trainee);

/// The word by which a session's trainee is known best: user id, else code, else name; empty for nobody.
std::string trainee_of(const nlohmann::json& session);

/// Whether it says how well somebody reams: a person held the device, and bone was cut. Demos, scripted
/// runs and plates of studies of feel count for nobody.
bool is_attempt(const EndedSession& session);

/// Its cusum stays empty.
score::LearningPoint learning_point(const EndedSession& session, const score::Score& score);

/// Sessions as their metrics.json has them, judged by one rubric. A session without metrics.json is left out,
/// and so is what is no attempt.
score::LearningCurve learning_of(const std::vector<EndedSession>& sessions, const score::Rubric& rubric,
                                 const score::CusumParameters& parameters);

}  // namespace ream::session
