#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "core/error.hpp"
#include "core/json.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

const std::string users_path = "/api/v1/users";

access::NewUser new_user_from(const json& body) {
  return {body.at("name"), text_in(body, "display_name"), *access::role_from(body.at("role")),
          access::Secret(body.at("password").get<std::string>())};
}

access::UserChange user_change_from(const json& body) {
  access::UserChange wanted{optional_in<std::string>(body, "display_name"),
                            access::role_from(text_in(body, "role")),
                            optional_in<bool>(body, "enabled"),
                            {}};
  if (auto password = optional_in<std::string>(body, "password"))
    wanted.password = access::Secret(std::move(*password));
  wanted.keep_tokens = body.value("keep_tokens", false);
  return wanted;
}

net::Response list_users(const Services& services, const net::Request&) {
  json users = json::array();
  for (const access::User& user : services.access_control.users.list()) users.push_back(user_json(user));
  return net::json_response(200, {{"users", std::move(users)}});
}

net::Response add_user(const Services& services, const net::Request& request) {
  const access::User user = services.access_control.users.add(new_user_from(body_of(request)));
  services.audit(request, "user.add", user.id, user.name + " as " + access::to_text(user.role));
  return created(users_path + "/" + user.id, user_json(user));
}

/// What was changed, without what is secret.
std::string words_of(const access::UserChange& change) {
  std::string words;
  const auto add = [&words](const std::string& word) { words += (words.empty() ? "" : ", ") + word; };
  if (change.display_name) add("name to show");
  if (change.role) add("role " + access::to_text(*change.role));
  if (change.enabled) add(*change.enabled ? "enabled" : "disabled");
  if (change.password) add(change.keep_tokens ? "password, tokens stay" : "password");
  return words;
}

net::Response change_user(const Services& services, const net::Request& request) {
  const access::UserChange wanted = user_change_from(body_of(request));
  const access::User user = services.access_control.users.change(id_of(request), wanted);
  services.audit(request, "user.change", user.id, user.name + ": " + words_of(wanted));
  return net::json_response(200, user_json(user));
}

net::Response remove_user(const Services& services, const net::Request& request) {
  const access::User user = services.access_control.users.get(id_of(request));
  services.access_control.users.remove(user.id);
  services.audit(request, "user.remove", user.id, user.name);
  return no_content();
}

net::Response get_user(const Services& services, const net::Request& request) {
  return net::json_response(200, user_json(services.access_control.users.get(id_of(request))));
}

}  // namespace

std::vector<Route> user_routes() {
  using namespace access;
  const std::string one = users_path + "/{id}";
  return {{"GET", users_path, staff, not_audited, list_users},
          {"POST", users_path, operators, audited_by_handler, add_user, {"user", "created"}},
          {"GET", one, staff, not_audited, get_user},
          {"PATCH", one, operators, audited_by_handler, change_user, {"user", "changed"}},
          {"DELETE", one, operators, audited_by_handler, remove_user, {"user", "deleted"}}};
}

}  // namespace ream::api
