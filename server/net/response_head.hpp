#pragma once
#include <string>

#include "net/message.hpp"

namespace ream::net {

/// The head of a reply as it goes over the wire, up to and including the empty line: status, the reply's own
/// headers, those of `fixed` that it does not set itself, length and connection. A header that would break
/// out of its line is left out, and logged by its name.
std::string response_head(const Response& response,
                          const std::vector<std::pair<std::string, std::string>>& fixed, bool keep_alive);

}  // namespace ream::net
