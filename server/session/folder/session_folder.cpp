#include "session/folder/session_folder.hpp"

#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "core/new_id.hpp"
#include "core/text.hpp"
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
  if (mark.at("points").is_number()) read.points = mark.at("points").get<double>();
  if (mark.at("outcome").is_string()) read.outcome = mark.at("outcome").get<std::string>();
  read.rubric = mark.at("rubric").get<std::string>();
  read.version = mark.at("version").get<int>();
  return read;
}

/// The mark of a score.json, in the keys that record_from_text() reads; null without one.
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

/// `timing` and `mark` may be null.
FolderRecord record_of(const json& session, const json& timing, const json& mark, const fs::path& folder) {
  FolderRecord found;
  SessionRecord& record = found.record;
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
  found.lasting = !is_live(status.state);
  if (!found.lasting && !FileLock::held(lock_file(folder))) status.state = SessionState::interrupted;
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
  if (!is_live(status.state)) record.mark = mark_from(mark);
  return found;
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
FolderRecord checked(const fs::path& folder, Read&& read) {
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

FolderRecord read_session_folder(const fs::path& folder) {
  json session = read_json_file(session_json(folder)), timing;
  std::error_code failed;
  if (const fs::path file = folder / "timing.json"; fs::exists(file, failed)) timing = read_json_file(file);
  return checked(folder, [&] {
    if (session.value("created_utc", "").empty()) session["created_utc"] = changed_utc(session_json(folder));
    json mark = mark_in(folder);
    FolderRecord found = record_of(session, timing, mark, folder);
    found.text =
        json{{"session", std::move(session)}, {"timing", std::move(timing)}, {"mark", std::move(mark)}}
            .dump();
    return found;
  });
}

FolderRecord record_from_text(const std::string& text, const fs::path& folder) {
  return checked(folder, [&] {
    const json files = json::parse(text);
    FolderRecord found =
        record_of(files.at("session"), files.at("timing"), files.value("mark", json()), folder);
    found.text = text;
    return found;
  });
}

int64_t session_stamp(const fs::path& folder) {
  const int64_t of_session = file_stamp(session_json(folder));
  return of_session == 0 ? 0 : of_session + file_stamp(score_json(folder));
}

}  // namespace ream::session
