#pragma once
#include <chrono>

namespace ream {

/// From now on SIGINT, SIGTERM, SIGQUIT and SIGHUP (unless nohup has it ignored) only set a flag, so that
/// long work can stop without leaving half-written files and a device is left without force. A process that
/// has not ended `timeout` later gets SIGALRM, which ends it.
void catch_interrupts(std::chrono::seconds timeout = std::chrono::seconds(60));
bool interrupted() noexcept;

/// From now on a write beyond the process' limit of file size, or to a pipe that nobody reads any more, fails
/// like one to a full disk, with words, instead of ending the process.
void take_failed_writes_as_errors();

/// Throws Error io "interrupted; nothing was written" once a signal has come.
void throw_if_interrupted();

}  // namespace ream
