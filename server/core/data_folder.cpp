#include "core/data_folder.hpp"

#include <sys/stat.h>

#include <cstdlib>

#include "core/error.hpp"
#include "core/file.hpp"

namespace ream {

std::filesystem::path data_folder(const std::filesystem::path& chosen) {
  if (!chosen.empty()) return chosen;
  if (const char* data = std::getenv("REAM_DATA"); data != nullptr && *data != '\0') return data;
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return std::filesystem::path(home) / ".local/share/ream";
  throw Error(ErrorKind::usage, "no data folder: give --data DIR, or set REAM_DATA or HOME");
}

void make_data_folder(const std::filesystem::path& data) try {
  std::error_code failed;
  const bool is_new = !std::filesystem::exists(data, failed);
  make_writable_folder(data);
  if (is_new) std::filesystem::permissions(data, std::filesystem::perms::owner_all, failed);
} catch (const Error& e) {
  throw Error(e.kind(), std::string(e.what()) + "; choose another data folder with --data");
}

std::string data_folder_warning(const std::filesystem::path& data) {
  using std::filesystem::perms;
  std::error_code failed;
  const perms open =
      std::filesystem::status(data, failed).permissions() & (perms::group_all | perms::others_all);
  if (failed || open == perms::none) return {};
  return "other users of this machine can look into " + data.string() + "; run chmod 700 " + data.string();
}

void restrict_new_files_to_owner() noexcept { ::umask(S_IRWXG | S_IRWXO); }

std::filesystem::path cases_folder(const std::filesystem::path& data) { return data / "cases"; }
std::filesystem::path sessions_folder(const std::filesystem::path& data) { return data / "sessions"; }
std::filesystem::path serving_lock(const std::filesystem::path& data) { return data / "serving.lock"; }
std::filesystem::path rubrics_folder(const std::filesystem::path& data) { return data / "rubrics"; }
std::filesystem::path benchmarks_folder(const std::filesystem::path& data) { return data / "benchmarks"; }

std::filesystem::path case_path(const std::string& name, const std::filesystem::path& data) {
  const bool bare = name.find('/') == std::string::npos && name != "." && name != "..";
  return bare ? cases_folder(data_folder(data)) / name : std::filesystem::path(name);
}

}  // namespace ream
