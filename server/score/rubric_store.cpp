#include "score/rubric_store.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/folder_listing.hpp"

namespace ream::score {
namespace fs = std::filesystem;
namespace {

const std::string standard_id = "standard";

std::optional<int> version_in(const std::string& text) {
  int number = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failed != std::errc{} || end != text.data() + text.size() || number < 1) return std::nullopt;
  return number;
}

bool is_id(const std::string& id) {
  return !id.empty() && id.size() <= 64 && std::all_of(id.begin(), id.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
}

bool is_same_but_for_version(Rubric a, const Rubric& b) {
  a.version = b.version;
  return rubric_json(a) == rubric_json(b);
}

/// Gives a finished file its name, unless there is such a file already.
void publish(const fs::path& temporary, const fs::path& path, const std::string& id) {
  const bool done = ::link(temporary.c_str(), path.c_str()) == 0;
  const int why = errno;
  ::unlink(temporary.c_str());
  if (done) return sync_folder(path.parent_path());
  if (why == EEXIST)
    throw Error(ErrorKind::conflict, "rubric '" + id +
                                         "' was changed by somebody else at the same moment; look at "
                                         "its newest version and try again");
  throw Error(ErrorKind::io, "cannot write " + path.string() + ": " + std::strerror(why));
}

}  // namespace

fs::path RubricStore::file(const std::string& id, int version) const {
  return folder_ / id / (std::to_string(version) + ".json");
}

std::vector<std::string> RubricStore::ids() const {
  std::set<std::string> found = {standard_id};
  std::error_code gone;
  for (const fs::path& path : paths_in(folder_))
    if (fs::is_directory(path, gone) && is_id(path.filename())) found.insert(path.filename());
  return {found.begin(), found.end()};
}

std::vector<int> RubricStore::versions(const std::string& id) const {
  std::set<int> found;
  if (id == standard_id)
    for (const Rubric& shipped : standard_rubrics()) found.insert(shipped.version);
  if (is_id(id))
    for (const fs::path& path : paths_in(folder_ / id))
      if (path.extension() == ".json")
        if (const auto number = version_in(path.stem())) found.insert(*number);
  if (found.empty()) {
    std::string names;
    for (const std::string& name : ids()) names += (names.empty() ? "" : ", ") + name;
    throw Error(ErrorKind::not_found, "no rubric '" + id + "'; there are " + names);
  }
  return {found.begin(), found.end()};
}

Rubric RubricStore::get(const std::string& id, std::optional<int> version) const {
  const std::vector<int> stored = versions(id);
  const int requested = version.value_or(stored.back());
  if (std::find(stored.begin(), stored.end(), requested) == stored.end())
    throw Error(ErrorKind::not_found, "rubric '" + id + "' has no version " + std::to_string(requested) +
                                          "; its newest is " + std::to_string(stored.back()));
  std::error_code failed;
  const auto shipped = static_cast<size_t>(requested) - 1;
  if (id == standard_id && shipped < standard_rubrics().size() && !fs::exists(file(id, requested), failed))
    return standard_rubrics()[shipped];
  return load_rubric(file(id, requested));
}

Rubric RubricStore::find(const std::string& reference) const {
  const size_t at = reference.find('@');
  const std::string id = reference.substr(0, at);
  std::optional<int> version;
  if (at != std::string::npos) {
    version = version_in(reference.substr(at + 1));
    if (!version)
      throw Error(ErrorKind::invalid_input,
                  "'" + reference + "': behind the @ stands the version, a whole number from 1");
  }
  if (!is_id(id)) throw Error(ErrorKind::not_found, "no such rubric: " + reference);
  return get(id, version);
}

Rubric RubricStore::save(const std::string& id, Rubric rubric) const {
  if (!is_id(id))
    throw Error(ErrorKind::invalid_input,
                "a rubric's id is 1 to 64 of a-z, 0-9 and '-', and '" + id + "' is not");
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  std::error_code failed;
  int newest = 0;
  if (id == standard_id || fs::is_directory(folder_ / id, failed)) {
    const Rubric last = get(id);
    if (is_same_but_for_version(rubric, last)) return last;
    newest = last.version;
  }
  rubric.version = newest + 1;
  const nlohmann::json value = rubric_json(rubric);
  rubric_from_json(value, "rubric '" + id + "'");
  make_writable_folder(folder_ / id);
  const fs::path path = file(id, rubric.version);
  const fs::path temporary = path.string() + "." + std::to_string(::getpid()) + ".new";
  write_json_file(temporary, value);
  publish(temporary, path, id);
  return rubric;
}

Rubric find_rubric(const std::string& reference, const RubricStore& store) {
  std::error_code failed;
  return fs::is_regular_file(reference, failed) ? load_rubric(reference) : store.find(reference);
}

}  // namespace ream::score
