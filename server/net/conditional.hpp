#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "net/message.hpp"

namespace ream::net {

/// Strong entity tag of these bytes, with its quotes.
std::string entity_tag(std::span<const std::byte> bytes);

/// Whether a list as in If-None-Match ("*", or tags by commas) names `tag`. Weak comparison: W/"a" is "a".
bool names_tag(std::string_view list, std::string_view tag);
/// The same as If-Match and If-Range want it: a weak tag is equal to none.
bool names_tag_strongly(std::string_view list, std::string_view tag);

/// For GET and HEAD answered 200 with bytes: gives the reply the tag of its body where it has no ETag, and
/// makes it a 304 without a body when If-None-Match names that tag. Any other reply comes back as it was.
Response conditional(const Request& request, Response response);

/// Before a change to what has the tag `current`: throws RequestError 412 when If-Match is there and does not
/// name it. True when If-Match was there.
bool require_match(const Request& request, std::string_view current);

}  // namespace ream::net
