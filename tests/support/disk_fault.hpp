#pragma once

namespace ream::test {

/// What disk_fault_preload is told by the environment: one call of one kind on a file below a folder fails,
/// once. For memory_fault_preload there is no folder.
inline constexpr const char* disk_fault_folder_variable = "REAM_DISK_FAULT_BELOW";
/// "open", "write", "fsync" or "rename"; of memory "allocate", or "allocate-large" where only 4 kB and more
/// count, which fail when they are asked for again, too.
inline constexpr const char* disk_fault_call_variable = "REAM_DISK_FAULT_CALL";
/// Which of them, from 1 on; 0: none.
inline constexpr const char* disk_fault_number_variable = "REAM_DISK_FAULT_NUMBER";
/// File that says at the end of the program how many of them there were.
inline constexpr const char* disk_fault_count_variable = "REAM_DISK_FAULT_COUNT";

}  // namespace ream::test
