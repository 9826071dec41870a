#pragma once
#include <stdexcept>
#include <string>

namespace ream {

/// What went wrong, as far as a caller can act on it. Mapped once to exit codes (exit_code) and once to
/// problem+json (api). Used for set-up and requests only; the tick reports through status values.
enum class ErrorKind {
  usage,          ///< bad command line; exit code 2
  invalid_input,  ///< a file or request that cannot be used as it is
  not_found,      ///< a named thing does not exist
  conflict,       ///< the thing is not in a state that allows this
  unavailable,    ///< a resource (port, device, OpenCL) cannot be had now
  io,             ///< reading or writing failed
  cancelled,      ///< somebody asked for the work to end before it was done
};

/// The one exception family. The message is one line that names the thing, the place and what to do.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

/// 2 for usage, 1 for everything else.
constexpr int exit_code(ErrorKind kind) { return kind == ErrorKind::usage ? 2 : 1; }

}  // namespace ream
