#include "session/folder/session_labels.hpp"

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/json.hpp"
#include "session/folder/session_folder.hpp"

namespace ream::session {
using nlohmann::json;
namespace {

struct TextLabel {
  const char* key;
  std::string SessionRequest::*text;
};
constexpr std::array text_labels{TextLabel{"trainee_id", &SessionRequest::trainee_id},
                                 TextLabel{"trainee", &SessionRequest::trainee},
                                 TextLabel{"study", &SessionRequest::study},
                                 TextLabel{"participant", &SessionRequest::participant},
                                 TextLabel{"phase", &SessionRequest::phase},
                                 TextLabel{"title", &SessionRequest::title},
                                 TextLabel{"reset_of", &SessionRequest::reset_of},
                                 TextLabel{"followed_by", &SessionRequest::followed_by}};

constexpr double max_attempts = 1e6;

}  // namespace

void apply(const SessionChange& change, SessionRequest& request) {
  if (change.title) request.title = *change.title;
  if (change.trainee_id) request.trainee_id = *change.trainee_id;
  if (change.trainee) request.trainee = *change.trainee;
  if (change.keep) request.keep = *change.keep;
}

void read_labels(const json& session, SessionRequest& request) {
  for (const TextLabel& label : text_labels) request.*label.text = session.value(label.key, "");
  request.attempt = static_cast<int>(std::clamp(session.value("attempt", 1.0), 1.0, max_attempts));
  request.keep = session.value("keep", false);
  request.theatre = session.value("theatre", false);
}

void write_labels(const SessionRequest& request, json& session) {
  for (const TextLabel& label : text_labels) {
    session.erase(label.key);
    if (!(request.*label.text).empty()) session[label.key] = request.*label.text;
  }
  session.erase("attempt");
  if (request.attempt > 1) session["attempt"] = request.attempt;
  session.erase("keep");
  if (request.keep) session["keep"] = true;
  session["theatre"] = request.theatre;
}

json labels_json(const SessionRequest& request) {
  json labels = {{"attempt", request.attempt}, {"keep", request.keep}, {"theatre", request.theatre}};
  for (const TextLabel& label : text_labels) {
    labels[label.key] = or_null(request.*label.text);
  }
  return labels;
}

void relabel_folder(const std::filesystem::path& folder, const SessionRequest& request) {
  const std::string name = "session '" + folder.filename().string() + "'";
  std::error_code failed;
  if (!std::filesystem::exists(session_json(folder), failed))
    throw Error(ErrorKind::not_found, name + " left no folder; it was never started");
  const auto lock = FileLock::attempt(lock_file(folder));
  if (!lock) throw Error(ErrorKind::conflict, name + " is in use by another process");
  json session = read_json_file(session_json(folder));
  write_labels(request, session);
  write_json_file(session_json(folder), session);
}

}  // namespace ream::session
