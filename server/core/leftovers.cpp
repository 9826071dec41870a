#include "core/leftovers.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <functional>
#include <regex>
#include <vector>

#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file_lock.hpp"
#include "core/temporary_file.hpp"

namespace ream {
namespace fs = std::filesystem;
namespace {

constexpr const char* unfinished = ".ream-unfinished";

using IsLeftover = std::function<bool(const std::string& name)>;

bool is_ours(const fs::path& path) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0 && status.st_uid == ::geteuid();
}

size_t remove_from(const fs::path& folder, const IsLeftover& is_leftover) {
  std::error_code failed;
  std::vector<fs::path> found;
  for (fs::directory_iterator next(folder, failed), end; !failed && next != end; next.increment(failed))
    if (is_leftover(next->path().filename().string()) && is_ours(next->path())) found.push_back(next->path());
  size_t removed = 0;
  for (const fs::path& path : found) {
    const auto abandoned = FileLock::attempt_existing(path);
    if (abandoned && remove_tree(path)) ++removed;
  }
  return removed;
}

size_t remove_from_folders_in(const fs::path& parent, const IsLeftover& is_leftover) {
  std::error_code failed;
  size_t removed = 0;
  for (fs::directory_iterator next(parent, failed), end; !failed && next != end; next.increment(failed))
    if (fs::is_directory(next->symlink_status(failed))) removed += remove_from(next->path(), is_leftover);
  return removed;
}

bool under_construction(const std::string& name) {
  static const std::regex atomic(R"(.*\.[0-9]+(\.old)?\.tmp)");
  return std::regex_match(name, atomic);
}

bool temporary_folder_of_data(const std::string& name) {
  static const std::regex hidden(R"(\..+\.[A-Za-z0-9]{6})");
  return std::regex_match(name, hidden);
}

bool temporary_folder_of_system(const std::string& name) {
  static const std::regex named(R"(ream-(read|ct|reamer|picture)\.[A-Za-z0-9]{6})");
  return std::regex_match(name, named);
}

bool deleted_case(const std::string& name) { return name.starts_with('.') && name.ends_with(".deleted"); }

}  // namespace

size_t remove_leftovers(const fs::path& data) {
  std::error_code none;
  size_t removed = remove_from(data, temporary_folder_of_data) + remove_from(data, under_construction);
  removed += remove_from(cases_folder(data), deleted_case);
  for (const fs::path& folder :
       {cases_folder(data), sessions_folder(data), rubrics_folder(data), benchmarks_folder(data)})
    removed += remove_from(folder, under_construction);
  for (const fs::path& parent : {cases_folder(data), sessions_folder(data)})
    removed += remove_from_folders_in(parent, under_construction);
  const fs::path system = fs::temp_directory_path(none);
  return none ? removed : removed + remove_from(system, temporary_folder_of_system);
}

fs::path unfinished_beside(const fs::path& file) {
  const fs::path folder = fs::absolute(file).parent_path();
  std::error_code failed;
  if (!fs::is_directory(folder, failed)) {
    if (!failed) failed = std::make_error_code(std::errc::not_a_directory);
    throw Error(ErrorKind::io, "cannot write " + file.string() + ": " + failed.message());
  }
  return folder / unfinished;
}

size_t remove_leftovers_beside(const fs::path& file) {
  return remove_from(fs::absolute(file).parent_path(), [](const std::string& name) {
    return name.starts_with(unfinished) && temporary_folder_of_data(name);
  });
}

}  // namespace ream
