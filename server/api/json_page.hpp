#pragma once
#include <string>
#include <vector>

#include "core/json.hpp"
#include "net/message.hpp"

namespace ream::api {

/// Most items of a page of a list where the request does not say.
inline constexpr size_t default_page_size = 50;

/// ?limit of a request, which the contract has checked.
size_t limit_of(const net::Request& request);

/// Value of the Link header that leads to the page behind `cursor`.
std::string next_link(const net::Request& request, const std::string& cursor);

/// 200 with a page of a list: `name` holds the items, `next` the cursor of the next page or null, `total` how
/// many there are on all; a Link header where there is a next page.
net::Response page_response(const net::Request& request, const std::string& name, nlohmann::json items,
                            const std::string& next, size_t total);

/// A page of items that are all here: objects, each with an "id" of its own. The request's ?sort is a key of
/// theirs, behind "-" for the other way about; ?limit and ?cursor as everywhere. Error invalid_input for a
/// cursor that this list has not given.
net::Response page_of(const net::Request& request, const std::string& name, std::vector<nlohmann::json> items,
                      const std::string& default_sort);

}  // namespace ream::api
