#pragma once
#include <string>

#include "access/secret.hpp"

namespace ream::app {

/// A new password: at a terminal asked for twice and not shown, else the first line of stdin. Errors:
/// invalid_input when the two differ or nothing comes, cancelled by Ctrl-C. Never from the command line,
/// where everybody on the machine can read it.
access::Secret ask_new_password(const std::string& whose);

}  // namespace ream::app
