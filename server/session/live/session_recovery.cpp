#include "session/live/session_recovery.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/atomic_file.hpp"
#include "core/clock.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/folder_listing.hpp"
#include "core/text.hpp"
#include "record/op_log.hpp"
#include "session/folder/session_folder.hpp"
#include "session/scoring/rescoring.hpp"
#include "session/scoring/score_document.hpp"

namespace ream::session {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr uint64_t max_cut_bytes = 1'000'000;

std::string seconds(uint32_t ticks) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f s", ticks * tick_s);
  return text;
}

/// What is to be written about a session that is closed now.
struct Closing {
  SessionState state;
  std::string words;
  uint32_t ticks = 0;
  std::optional<json> metrics;
};

/// About one whose recording cannot be used at all.
Closing without_recording(SessionState state, const std::string& cause, const Error& why) {
  return {state, cause + "; nothing of it can be used: " + why.what(), 0, {}};
}

Closing with_recording(const record::Recording& recording, const fs::path& data, SessionState state,
                       const std::string& cause) {
  Closing closing{state, {}, recording.tick_count(), {}};
  if (const auto& end = recording.end()) {
    closing.state = session_state_from(end->state).value_or(state);
    for (const record::ops::Event& event : recording.events())
      if (event.kind == end->state) closing.words = event.words;
  } else {
    closing.words = cause + "; everything up to " + seconds(closing.ticks) + " is kept";
    if (!recording.log().damage().empty()) closing.words += ": " + recording.log().damage();
  }
  closing.metrics = Rescorer(data).metrics(recording);
  return closing;
}

json session_of(const fs::path& folder, const Closing& closing) {
  json session = read_json_file(session_json(folder));
  session["state"] = to_text(closing.state);
  session["ticks"] = closing.ticks;
  if (closing.words.empty())
    session.erase("fault");
  else
    session["fault"] = closing.words;
  return session;
}

std::string pretty(const json& value) { return value.dump(2) + "\n"; }

void remove_temporaries(const fs::path& folder) {
  std::error_code failed;
  std::vector<fs::path> strays;
  for (fs::directory_iterator next(folder, failed), end; !failed && next != end; next.increment(failed))
    if (next->path().extension() == ".tmp") strays.push_back(next->path());
  for (const fs::path& stray : strays) fs::remove(stray, failed);
}

/// What is going to be cut off behind the recording's whole chunks, when that is more than a torn last one:
/// kept beside it as recording.ream.cut (recording.ream.cut.2, ...). Throws Error io.
void keep_what_is_cut(const record::OpLogReader& log) {
  const uint64_t size = fs::file_size(log.path()), cut = size - log.whole_bytes();
  const uint64_t chunk = log.chunks().empty() ? 0 : log.chunks().back().stored_bytes;
  if (cut <= std::min(chunk, max_cut_bytes)) return;
  std::ifstream from(log.path(), std::ios::binary);
  from.seekg(static_cast<std::streamoff>(log.whole_bytes()));
  fs::path kept = log.path();
  kept += ".cut";
  for (int n = 2; fs::exists(kept); ++n) kept = log.path().string() + ".cut." + std::to_string(n);
  std::ofstream to(kept, std::ios::binary);
  to << from.rdbuf();
  to.close();
  if (from && to && fs::file_size(kept) == cut) return;
  std::error_code ignored;
  fs::remove(kept, ignored);
  throw Error(ErrorKind::io, "cannot write " + kept.string());
}

/// A session whose session.json has a live state that no process stands for; its lock is held by the result.
std::optional<FileLock> left_alive(const fs::path& folder) {
  if (read_session_folder(folder).lasting) return std::nullopt;
  auto lock = FileLock::attempt(lock_file(folder));
  if (lock && read_session_folder(folder).lasting) return std::nullopt;
  return lock;
}

}  // namespace

std::string close_session_folder(const fs::path& folder, const fs::path& data, SessionState state,
                                 const std::string& cause) {
  std::optional<record::Recording> recording;
  std::optional<Closing> closing;
  try {
    recording.emplace(recording_file(folder), record::Recording::Trust::checked);
    closing = with_recording(*recording, data, state, cause);
  } catch (const Error& e) {
    if (e.kind() == ErrorKind::io) throw;
    recording.reset();
    closing = without_recording(state, cause, e);
  }
  const auto prepare = [](AtomicFile& file, const json& contents) {
    file.write(pretty(contents));
    file.finish();
  };
  std::optional<AtomicFile> metrics;
  if (closing->metrics) prepare(metrics.emplace(metrics_json(folder)), *closing->metrics);
  AtomicFile session(session_json(folder));
  prepare(session, session_of(folder, *closing));
  if (recording && !recording->end()) {
    keep_what_is_cut(recording->log());
    record::append_notes(recording->log(),
                         {record::ops::Event{closing->ticks, to_text(state), closing->words},
                          record::ops::End{closing->ticks, to_text(state)}});
  }
  if (metrics) metrics->commit();
  session.commit();
  if (metrics) keep_score(folder, data);
  remove_temporaries(folder);
  return closing->words;
}

std::vector<std::string> recover_sessions(const fs::path& data) {
  std::vector<std::string> lines;
  for (const fs::path& folder : paths_in(sessions_folder(data))) {
    const std::string id = folder.filename().string();
    std::error_code no_file;
    if (!is_name(id) || !fs::exists(session_json(folder), no_file)) continue;
    std::optional<FileLock> lock;
    try {
      lock = left_alive(folder);
    } catch (const Error&) {
      continue;  // damaged: whoever lists sessions says so
    }
    if (!lock) continue;
    try {
      const std::string words =
          close_session_folder(folder, data, SessionState::interrupted, "the server ended in mid-session");
      lines.push_back("session " + id + ": " + (words.empty() ? "it had ended in order" : words));
    } catch (const Error& e) {
      lines.push_back("session " + id + " could not be closed and is left as it was: " + e.what());
    }
  }
  return lines;
}

}  // namespace ream::session
