#include "api/user_json.hpp"

#include "core/json.hpp"

namespace ream::api {

nlohmann::json user_json(const access::User& user) {
  return {{"id", user.id},
          {"name", user.name},
          {"display_name", user.display_name},
          {"role", access::to_text(user.role)},
          {"enabled", user.enabled},
          {"created_utc", user.created_utc}};
}

}  // namespace ream::api
