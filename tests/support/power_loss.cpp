#include "support/power_loss.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace ream::test {
namespace fs = std::filesystem;
namespace {

std::string listing(const fs::path& folder) {
  std::string lines;
  for (const auto& entry : fs::directory_iterator(folder))
    lines += identity_on_disk(AT_FDCWD, entry.path().c_str()) + ' ' + entry.path().filename().string() + '\n';
  return lines;
}

/// Copies what is left of one folder, and of those in it.
void copy_left(const std::string& identity, const fs::path& now, const fs::path& kept, Lost lost,
               const fs::path& to) {
  fs::create_directory(to);
  std::istringstream entries;
  if (lost == Lost::bytes) {
    entries.str(listing(now));
  } else {
    std::ostringstream text;
    if (std::ifstream in(kept / identity); in.peek() != EOF) text << in.rdbuf();
    entries.str(text.str());
  }
  for (std::string entry, name; entries >> entry && std::getline(entries, name);) {
    name.erase(0, 1);
    if (entry.starts_with('d')) {
      copy_left(entry, now / name, kept, lost, to / name);
    } else if (fs::exists(kept / entry)) {
      fs::copy_file(kept / entry, to / name);
    } else {
      std::ofstream(to / name);  // its name, and none of its bytes
    }
  }
}

}  // namespace

void lose_power(const fs::path& folder, const fs::path& kept, Lost lost) {
  const fs::path left = folder.string() + ".left";
  copy_left(identity_on_disk(AT_FDCWD, folder.c_str()), folder, kept, lost, left);
  fs::remove_all(folder);
  fs::rename(left, folder);
}

void keep_tree(const fs::path& folder, const fs::path& kept) {
  fs::create_directories(kept);
  const auto keep_folder = [&](const fs::path& path) {
    std::ofstream(kept / identity_on_disk(AT_FDCWD, path.c_str())) << listing(path);
  };
  keep_folder(folder);
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory())
      keep_folder(entry.path());
    else if (entry.is_regular_file())
      fs::copy_file(entry.path(), kept / identity_on_disk(AT_FDCWD, entry.path().c_str()),
                    fs::copy_options::overwrite_existing);
  }
}

}  // namespace ream::test
