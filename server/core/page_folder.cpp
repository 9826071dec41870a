#include "core/page_folder.hpp"

#include "core/error.hpp"

namespace ream {
namespace fs = std::filesystem;

fs::path page_folder(const fs::path& chosen) {
  std::error_code failed;
  if (!chosen.empty()) {
    if (!fs::is_regular_file(chosen / "index.html", failed))
      throw Error(ErrorKind::not_found,
                  "no index.html in " + chosen.string() + "; build the page or correct --web");
    return chosen;
  }
  const fs::path beside = fs::read_symlink("/proc/self/exe", failed).parent_path().parent_path();
  for (const fs::path& folder : {beside / "share/ream/web", beside / "web/dist"})
    if (fs::is_regular_file(folder / "index.html", failed)) return folder;
  return {};
}

}  // namespace ream
