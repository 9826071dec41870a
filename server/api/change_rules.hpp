#pragma once
#include <optional>
#include <string>

#include "api/change_feed.hpp"
#include "net/message.hpp"

namespace ream::api {

/// The change that a request has made, by its route, once it was answered with `response`; none where the
/// route changes nothing that is told, or whoever carried it out tells of it. Of changes to a session the
/// caller sets `session`.
std::optional<Change> change_made(const net::Request& request, const std::string& pattern,
                                  const net::Response& response);

}  // namespace ream::api
