#include "session/export/session_bundle.hpp"
#include "session/folder/black_box_files.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/leftovers.hpp"
#include "core/log.hpp"
#include "core/temporary_file.hpp"
#include "isolation/isolated_job.hpp"
#include "session/folder/session_labels.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/recorded_session.hpp"
#include "session/simulation/simulation.hpp"
#include "store/zip_archive.hpp"

namespace ream::session {
namespace {

namespace fs = std::filesystem;

const std::string format = "ream session bundle";
constexpr int revision = 1;

/// What may be in a session's or case's folder and is worth taking along.
const std::set<std::string> session_files{"session.json", "recording.ream", "metrics.json",
                                          "score.json",   "timing.json",    "trace.csv",
                                          "reamed.ply",   "snapshot.png",   "black-box.csv"};
const std::set<std::string> case_files{"case.json", "plan.json", "density.zst", "coverage.zst"};

bool is_id(const std::string& name) {
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
}

/// A server's session has an id; a run's folder is named by what it holds.
std::string session_id(const fs::path& folder, const record::Recording& recording) {
  std::error_code failed;
  if (fs::is_regular_file(folder / "session.json", failed)) {
    const nlohmann::json session = read_json_file(folder / "session.json");
    if (session.is_object() && session.contains("id") && session["id"].is_string() &&
        is_id(session["id"].get<std::string>()))
      return session["id"].get<std::string>();
  }
  const auto checkpoints = recording.checkpoints();
  return "run" +
         to_hex(checkpoints.empty() ? recording.header().start_grid_hash : checkpoints.back().session_hash);
}

void add_files(const fs::path& folder, const std::set<std::string>& names, const std::string& under,
               std::vector<store::ArchiveEntry>& entries) {
  std::error_code failed;
  for (const std::string& name : names)
    if (fs::is_regular_file(folder / name, failed)) entries.push_back({folder / name, under + "/" + name});
}

/// Puts a session.json with these labels in place of the one in the folder.
void relabel(const fs::path& folder, const SessionRequest& labels, const fs::path& made,
             std::vector<store::ArchiveEntry>& entries) {
  nlohmann::json session = read_json_file(folder / "session.json");
  write_labels(labels, session);
  write_json_file(made / "session.json", session);
  for (store::ArchiveEntry& entry : entries)
    if (entry.name == "session/session.json") entry.file = made / "session.json";
}

bool is_zip(const fs::path& file) {
  std::array<char, 2> begin{};
  return std::ifstream(file, std::ios::binary).read(begin.data(), begin.size()) && begin[0] == 'P' &&
         begin[1] == 'K';
}

/// Moves the regular files of these names, if they are there.
void take_files(const fs::path& from, const std::set<std::string>& names, const fs::path& to) {
  fs::create_directory(to);
  for (const std::string& name : names)
    if (fs::is_regular_file(fs::symlink_status(from / name))) fs::rename(from / name, to / name);
}

/// Whom a session of another machine is of is nobody here, or somebody else.
void drop_labels(const fs::path& session_file) {
  nlohmann::json session = read_json_file(session_file);
  if (!session.is_object())
    throw Error(ErrorKind::invalid_input, "session.json of the bundle holds no session");
  for (const char* key : {"trainee_id", "trainee", "study", "participant", "phase"}) session.erase(key);
  write_json_file(session_file, session);
}

nlohmann::json read_bundle_json(const fs::path& folder, const fs::path& zip) {
  const nlohmann::json bundle = read_json_file(folder / "bundle.json");
  const auto refuse = [&](const std::string& why) {
    return Error(ErrorKind::invalid_input, zip.string() + " is no session bundle: " + why);
  };
  if (!bundle.is_object() || bundle.value("format", "") != format) throw refuse("bundle.json says so");
  if (bundle.value("revision", 0) != revision)
    throw refuse("it was made by a newer version; update this one");
  for (const char* key : {"session", "case"})
    if (!bundle.contains(key) || !bundle[key].is_string() || !is_id(bundle[key].get<std::string>()))
      throw refuse(std::string("bundle.json has no usable '") + key + "'");
  return bundle;
}

}  // namespace

void write_session_bundle(const fs::path& recording_file, const std::string& case_name, const fs::path& data,
                          const fs::path& zip, const SessionRequest* labels, const Progress& progress) {
  const record::Recording recording(recording_file, record::Recording::Trust::checked);
  if (const std::string& damage = recording.log().damage(); !damage.empty()) log::warn(damage);
  case_of(recording, case_name, data);
  const fs::path folder = fs::absolute(recording_file).parent_path();
  const TemporaryFolder made(unfinished_beside(zip));
  const nlohmann::json bundle = {{"format", format},
                                 {"revision", revision},
                                 {"session", session_id(folder, recording)},
                                 {"case", recording.header().case_id}};
  write_json_file(made.path() / "bundle.json", bundle);
  std::vector<store::ArchiveEntry> entries{{made.path() / "bundle.json", "bundle.json"}};
  add_files(folder, session_files, "session", entries);
  if (labels != nullptr && fs::is_regular_file(folder / "session.json"))
    relabel(folder, *labels, made.path(), entries);
  for (const fs::path& box : black_boxes_in(folder))
    entries.push_back({box, "session/" + box.filename().string()});
  add_files(case_folder_of(case_name.empty() ? recording.header().case_id : case_name, data), case_files,
            "case", entries);
  store::write_zip(zip, entries, progress);
}

bool is_session_bundle(const fs::path& file) {
  std::error_code failed;
  if (!fs::is_regular_file(file, failed) || !is_zip(file)) return false;
  isolation::IsolatedJob job;
  job.task = "session";
  job.input = file;
  job.options = {{"only_ask", true}};
  try {
    return isolation::run_isolated(job).answer().value("holds_session", false);
  } catch (const Error&) {
    return false;  // what it is instead is said by who reads it
  }
}

std::string import_session_bundle(const fs::path& zip, const fs::path& data, bool keep_labels) {
  make_writable_folder(sessions_folder(data));
  make_writable_folder(cases_folder(data));
  isolation::IsolatedJob job;
  job.task = "session";
  job.input = zip;
  job.options = {{"only_ask", false}};
  job.scratch = data;
  const isolation::IsolatedResult read = isolation::run_isolated(job);
  const fs::path unpacked = read.folder() / "session_bundle";
  const nlohmann::json bundle = read_bundle_json(unpacked, zip);
  const std::string session = bundle["session"], case_id = bundle["case"];
  const fs::path session_to = sessions_folder(data) / session, case_to = cases_folder(data) / case_id;
  if (fs::exists(session_to))
    throw Error(ErrorKind::conflict, "session '" + session + "' is in the data folder already");
  const bool known = fs::exists(case_to);
  const nlohmann::json hash = known ? nlohmann::json(case_::case_hash(case_::load_case(case_to)))
                                    : read.answer().value("enclosed_case", nlohmann::json());
  if (hash.is_null() || hash != read.answer().value("recorded_case", nlohmann::json()) ||
      read.answer().value("case_id", "") != case_id)
    throw Error(
        ErrorKind::conflict,
        known ? "another case '" + case_id + "' is in the data folder; import with --data into one of its own"
              : zip.string() + " holds a case that is not its session's");
  const TemporaryFolder made(data / ".bundle");
  std::set<std::string> names = session_files;
  for (const fs::path& box : black_boxes_in(unpacked / "session")) names.insert(box.filename().string());
  take_files(unpacked / "session", names, made.path() / "session");
  if (!keep_labels && fs::exists(made.path() / "session/session.json"))
    drop_labels(made.path() / "session/session.json");
  if (!known) take_files(unpacked / "case", case_files, made.path() / "case");
  sync_tree(made.path());
  if (!known) fs::rename(made.path() / "case", case_to);
  std::error_code failed;
  fs::rename(made.path() / "session", session_to, failed);
  if (failed) {
    std::error_code ignored;
    if (!known) fs::rename(case_to, made.path() / "case", ignored);
    throw Error(ErrorKind::io, "cannot write " + session_to.string() + ": " + failed.message());
  }
  sync_folder(cases_folder(data));
  sync_folder(sessions_folder(data));
  return session;
}

}  // namespace ream::session
