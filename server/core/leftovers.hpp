#pragma once
#include <cstddef>
#include <filesystem>

namespace ream {

/// Removes from a data folder, and from the system's folder for temporary files, what was under construction
/// when an earlier program was killed: AtomicFile, AtomicFolder, TemporaryFolder, and cases on their way out.
/// Whoever still works on such a thing holds a lock on it, so this may be called at any time. Returns how
/// many files and folders are gone; what cannot be removed stays.
size_t remove_leftovers(const std::filesystem::path& data);
/// What to name a TemporaryFolder after in which a file is made that may hold what others must not see. Error
/// io where there is no folder for the file.
std::filesystem::path unfinished_beside(const std::filesystem::path& file);
/// The same as remove_leftovers() for what unfinished_beside() named, whatever the file is called.
size_t remove_leftovers_beside(const std::filesystem::path& file);

}  // namespace ream
