#pragma once
#include <cstddef>
#include <string_view>

#include "net/limits.hpp"

namespace ream::net {

/// Refuses a request's head that is too large or that two readers could read differently (request smuggling):
/// stray CR or LF, control characters, continued lines, white space before a colon, two lengths or hosts, a
/// length beside a transfer coding, any coding but "chunked". `head` ends with its empty line.
/// Throws RequestError 400, 414 (request line) or 431.
void require_plain_head(std::string_view head, const Limits& limits);

/// Of a head that has not come whole yet: the same for its size and its single characters, those before
/// `from` left out.
void require_plain_beginning(std::string_view beginning, size_t from, const Limits& limits);

}  // namespace ream::net
