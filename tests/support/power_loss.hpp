#pragma once
#include <fcntl.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

namespace ream::test {

/// Names the folder where power_loss_preload keeps what was synced.
inline constexpr const char* power_loss_variable = "REAM_POWER_LOSS_KEPT";

/// What a file or folder is called whatever its name: kind, number and time of birth, as numbers are used
/// again. Empty when it is gone.
inline std::string identity_on_disk(int folder, const char* name, bool follow = false) {
  struct statx found {};
  if (::statx(folder, name, follow ? 0 : AT_SYMLINK_NOFOLLOW, STATX_INO | STATX_BTIME | STATX_TYPE, &found) !=
      0)
    return {};
  return std::string(S_ISDIR(found.stx_mode) ? "d" : "f") + std::to_string(found.stx_ino) + "-" +
         std::to_string(found.stx_btime.tv_sec) + "." + std::to_string(found.stx_btime.tv_nsec);
}

/// What else is lost beside the bytes of files that were not synced.
enum class Lost {
  names,  ///< what a folder was told after it was last synced: new, moved and removed names
  bytes   ///< nothing: names are as they were when the power went
};

/// Makes of `folder`, which a killed program wrote with power_loss_preload, what a disk would hold: `kept` is
/// that library's folder, and `folder` was given to keep_tree() before the program began.
void lose_power(const std::filesystem::path& folder, const std::filesystem::path& kept, Lost lost);

/// Keeps a whole folder, as if it had lain on the disk for long.
void keep_tree(const std::filesystem::path& folder, const std::filesystem::path& kept);

}  // namespace ream::test
