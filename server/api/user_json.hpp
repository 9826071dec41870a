#pragma once
#include <nlohmann/json_fwd.hpp>

#include "access/users.hpp"

namespace ream::api {

/// As proto/openapi.yaml has a user.
nlohmann::json user_json(const access::User& user);

}  // namespace ream::api
