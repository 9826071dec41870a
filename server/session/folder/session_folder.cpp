#include "session/folder/session_folder.hpp"

#include <sys/stat.h>

#include <algorithm>

#include "case/two_plates.hpp"
#include "core/clock.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/json.hpp"
#include "core/log.hpp"
#include "core/new_id.hpp"
#include "core/text.hpp"
#include "score/rubric.hpp"
#include "session/folder/session_labels.hpp"
#include "session/folder/timing_file.hpp"

namespace ream::session {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

std::string changed_utc(const fs::path& file) {
  struct stat about {};
  ::stat(file.c_str(), &about);
  return utc_text(about.st_mtime);
}

/// Scripts and cases of runs from the command line may be paths.
std::string plain_name(const std::string& text) {
  if (is_name(text)) return text;
  const std::string stem = fs::path(text).stem().string();
  return is_name(stem) ? stem : "unnamed";
}

SessionState state_of(const json& session, const fs::path& folder) {
  const std::string word = session.value("state", "finished");
  const auto state = session_state_from(word);
  if (!state)
    throw Error(ErrorKind::invalid_input,
                session_json(folder).string() + ": '" + word + "' is no state of a session");
  return *state;
}

/// Throws json::exception.
std::optional<SessionMark> mark_from(const json& mark) {
  if (!mark.is_object()) return std::nullopt;
  SessionMark read;
  if (mark.at("points").is_number()) read.points = score::rounded_points(mark.at("points").get<double>());
  if (mark.at("outcome").is_string()) read.outcome = mark.at("outcome").get<std::string>();
  read.rubric = mark.at("rubric").get<std::string>();
  read.version = mark.at("version").get<int>();
  return read;
}

/// The mark of a score.json, in the keys that mark_from() reads; null without one.
json mark_in(const fs::path& folder) {
  std::error_code failed;
  if (!fs::exists(score_json(folder), failed)) return nullptr;
  try {
    const json score = read_json_file(score_json(folder)).at("score");
    json mark = json::object();
    for (const char* key : {"points", "outcome", "rubric", "version"}) mark[key] = score.at(key);
    mark_from(mark);
    return mark;
  } catch (const std::exception& damage) {
    log::warn(folder.string() + ": its score is left out: " + damage.what());
    return nullptr;
  }
}

/// What a session's files say, as the index keeps it: "session", "timing" and "mark", the last two may be
/// null.
json read_files(const fs::path& folder) {
  json files = {{"session", read_json_file(session_json(folder))}, {"timing", nullptr}};
  std::error_code failed;
  if (const fs::path file = folder / "timing.json"; fs::exists(file, failed))
    files["timing"] = read_json_file(file);
  return files;
}

/// Throws json::exception, as the next.
void complete(json& files, const fs::path& folder) {
  if (files["session"].value("created_utc", "").empty())
    files["session"]["created_utc"] = changed_utc(session_json(folder));
  files["mark"] = mark_in(folder);
}

SessionRecord record_of(const json& files, const fs::path& folder) {
  const json &session = files.at("session"), &timing = files.at("timing");
  SessionRecord record;
  record.streamable = false;
  record.request.id = folder.filename().string();
  record.request.case_id = plain_name(session.value("case", ""));
  record.request.script = plain_name(session.value("script", ""));
  record.request.device = session.value("device", "script");
  // A script's own says itself.
  if (record.request.device != "script") record.request.device_profile = session.value("device_profile", "");
  record.request.created_utc = session.value("created_utc", "");
  read_labels(session, record.request);
  SessionStatus& status = record.status;
  status.state = state_of(session, folder);
  record.lasting = !is_live(status.state);
  if (!record.lasting && !FileLock::held(lock_file(folder))) status.state = SessionState::interrupted;
  status.device.name = record.request.device;
  status.device.profile = session.value("device_profile", "");
  status.force_scale = session.value("force_scale", 1.0);
  status.fault = session.value("fault", "");
  status.tick = session.value("ticks", 0u);
  if (timing.is_object()) {
    status.loop = loop_health_from(timing);
    if (!session.contains("ticks")) status.tick = timing.value("ticks", 0u);
  }
  status.duration_s = status.tick * tick_s;
  if (!is_live(status.state)) record.mark = mark_from(files.value("mark", json()));
  return record;
}

/// JSON may hold a NUL, a database's text may not.
std::string without_nul(std::string text) {
  text.erase(std::remove(text.begin(), text.end(), '\0'), text.end());
  return text;
}

/// Differs after the file has been replaced; zero without one. The time of change alone may be the same for
/// two files made within one tick of the file system's clock.
int64_t file_stamp(const fs::path& file) {
  struct stat about {};
  if (::stat(file.c_str(), &about) != 0) return 0;
  return about.st_mtim.tv_sec * 1'000'000'000 + about.st_mtim.tv_nsec + static_cast<int64_t>(about.st_ino);
}

/// Runs what reads the files' JSON.
template <typename Read>
auto checked(const fs::path& folder, Read&& read) {
  try {
    return read();
  } catch (const json::exception&) {
    throw Error(ErrorKind::invalid_input,
                session_json(folder).string() + " or timing.json beside it is not as sessions have them");
  }
}

}  // namespace

fs::path session_json(const fs::path& folder) { return folder / "session.json"; }
fs::path metrics_json(const fs::path& folder) { return folder / "metrics.json"; }
fs::path score_json(const fs::path& folder) { return folder / "score.json"; }
fs::path recording_file(const fs::path& folder) { return folder / "recording.ream"; }
fs::path lock_file(const fs::path& folder) { return folder / "lock"; }

SessionRecord read_session_folder(const fs::path& folder) {
  json files = read_files(folder);
  return checked(folder, [&] {
    complete(files, folder);
    return record_of(files, folder);
  });
}

store::SessionRow row_of(const SessionRecord& record) {
  const SessionRequest& request = record.request;
  store::SessionRow row;
  row.id = request.id;
  row.case_id = request.case_id;
  row.script = request.script;
  row.state = to_text(record.status.state);
  row.created_utc = without_nul(request.created_utc);
  row.duration_s = record.status.duration_s;
  row.trainee_id = without_nul(request.trainee_id);
  // Lists are sorted and searched by it, also by those for whom the person is hidden.
  row.trainee = without_nul(request.study.empty() ? request.trainee : request.participant);
  row.study = without_nul(request.study);
  row.participant = without_nul(request.participant);
  row.title = without_nul(request.title);
  // On plates of studies of feel points mean nothing, and say what the plates are made of.
  if (record.mark && !case_::is_two_plates(request.case_id)) {
    row.points = record.mark->points;
    row.outcome = without_nul(record.mark->outcome);
  }
  row.lasting = record.lasting;
  return row;
}

store::SessionRow read_session_row(const fs::path& folder, int64_t stamp) {
  json files = read_files(folder);
  return checked(folder, [&] {
    complete(files, folder);
    store::SessionRow row = row_of(record_of(files, folder));
    row.record = files.dump();
    row.stamp = stamp;
    return row;
  });
}

SessionRecord record_of(const store::SessionRow& row, const fs::path& folder) {
  return checked(folder, [&] { return record_of(parse_json_or_discard(row.record), folder); });
}

int64_t session_stamp(const fs::path& folder) {
  const int64_t of_session = file_stamp(session_json(folder));
  return of_session == 0 ? 0 : of_session + file_stamp(score_json(folder));
}

}  // namespace ream::session
