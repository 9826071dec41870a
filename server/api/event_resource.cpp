#include "api/event_resource.hpp"

#include <charconv>

namespace ream::api {

void add_event_routes(net::Router& router, const std::shared_ptr<ChangeFeed>& feed) {
  router.on_websocket("/api/v1/events", [feed](const net::Request& request) {
    std::optional<uint64_t> since;
    if (const auto given = request.query.find("since"); given != request.query.end()) {
      const std::string& text = given->second;
      std::from_chars(text.data(), text.data() + text.size(), since.emplace(0));
    }
    return feed->listen(request.caller, since);
  });
}

}  // namespace ream::api
