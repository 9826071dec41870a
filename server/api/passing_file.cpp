#include "api/passing_file.hpp"

#include "api/new_id.hpp"

namespace ream::api {
namespace fs = std::filesystem;

PassingFile::PassingFile(const fs::path& folder, const std::string& ending) {
  const fs::path place = folder.empty() ? fs::temp_directory_path() : folder;
  fs::create_directories(place);
  path_ = place / ("ream-" + random_id() + ending);
}

PassingFile::~PassingFile() {
  std::error_code ignored;
  fs::remove(path_, ignored);
}

}  // namespace ream::api
