#include "session/folder/session_archive.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/folder_listing.hpp"
#include "core/log.hpp"
#include "core/text.hpp"

namespace ream::session {
namespace fs = std::filesystem;
namespace {

bool newer(const SessionRecord& a, const SessionRecord& b) {
  const SessionRequest &first = a.request, &second = b.request;
  return first.created_utc != second.created_utc ? first.created_utc > second.created_utc
                                                 : first.id < second.id;
}

}  // namespace

SessionArchive::SessionArchive(fs::path folder) : folder_(std::move(folder)) {}

SessionArchive::Known SessionArchive::look(const fs::path& folder) const {
  const std::string id = folder.filename().string();
  const int64_t stamp = session_stamp(folder);
  {
    const std::lock_guard lock(mutex_);
    const auto found = known_.find(id);
    if (found != known_.end() && found->second.stamp == stamp) return found->second;
  }
  Known known{stamp, std::nullopt, {}};
  if (stamp == 0) return known;
  bool lasting = true;
  try {
    known.record = read_session_folder(folder);
    lasting = known.record->lasting;
  } catch (const Error& damage) {
    known.damage = damage.what();
  }
  const std::lock_guard lock(mutex_);
  if (lasting) known_[id] = known;
  return known;
}

std::vector<std::string> SessionArchive::ids() const {
  std::vector<std::string> found;
  std::error_code gone;
  for (const fs::path& path : paths_in(folder_)) {
    std::string id = path.filename().string();
    if (is_name(id) && fs::is_directory(path, gone)) found.push_back(std::move(id));
  }
  return found;
}

std::vector<SessionRecord> SessionArchive::list() const {
  std::vector<SessionRecord> records;
  for (const std::string& id : ids()) {
    const bool known_before = [&] {
      const std::lock_guard lock(mutex_);
      return known_.contains(id);
    }();
    Known known = look(folder_of(id));
    if (known.record)
      records.push_back(std::move(*known.record));
    else if (!known.damage.empty() && !known_before)
      log::warn("session " + id + " is left out: " + known.damage);
  }
  std::sort(records.begin(), records.end(), newer);
  return records;
}

std::optional<SessionRecord> SessionArchive::find(const std::string& id) const {
  std::error_code failed;
  if (!is_name(id) || !fs::is_directory(folder_of(id), failed)) return std::nullopt;
  const Known known = look(folder_of(id));
  if (!known.record && !known.damage.empty()) throw Error(ErrorKind::invalid_input, known.damage);
  return known.record;
}

nlohmann::json SessionArchive::metrics(const std::string& id) const {
  if (!find(id)) throw Error(ErrorKind::not_found, "no session '" + id + "'");
  std::error_code failed;
  if (!fs::exists(metrics_json(folder_of(id)), failed))
    throw Error(ErrorKind::not_found, "session '" + id + "' left no metrics");
  return read_json_file(metrics_json(folder_of(id)));
}

}  // namespace ream::session
