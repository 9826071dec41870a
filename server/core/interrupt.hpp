#pragma once

namespace ream {

/// From now on SIGINT and SIGTERM only set a flag, so that long work can stop without leaving half-written
/// files and a device is left without force.
void catch_interrupts();
bool interrupted() noexcept;

/// From now on a write beyond the process' limit of file size fails like one to a full disk, with words,
/// instead of ending the process.
void take_file_size_limit_as_error();

/// Throws Error io "interrupted; nothing was written" once a signal has come.
void throw_if_interrupted();

}  // namespace ream
