#include "app/cli/case_path.hpp"

#include "app/data_folder.hpp"

namespace ream::app {

std::filesystem::path case_path(const std::string& name, const std::filesystem::path& data) {
  const bool bare = name.find('/') == std::string::npos && name != "." && name != "..";
  return bare ? cases_folder(data_folder(data)) / name : std::filesystem::path(name);
}

}  // namespace ream::app
