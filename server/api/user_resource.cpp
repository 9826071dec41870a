
#include "access/password_hasher.hpp"
#include "api/access_resource.hpp"
#include "api/request_body.hpp"
#include "api/user_json.hpp"
#include "core/error.hpp"
#include "core/json.hpp"

namespace ream::api {
using access::Role;
using nlohmann::json;
namespace {

constexpr size_t max_user_name = 64, longest_display_name = 100;
const std::string path = "/api/v1/users";
const std::vector<std::string> account_roles = {"operator", "instructor", "trainee"};

std::optional<access::Secret> password_in(RequestBody& body) {
  auto text = body.words_or_none("password", access::max_password_bytes);
  return text ? std::optional(access::Secret(std::move(*text))) : std::nullopt;
}

net::Response list(const AccessTools& tools) {
  json users = json::array();
  if (tools.gatehouse)
    for (const access::User& user : tools.gatehouse->users.list()) users.push_back(user_json(user));
  return net::json_response(200, {{"users", std::move(users)}});
}

net::Response add(const AccessTools& tools, const net::Request& request) {
  RequestBody body(request);
  access::NewUser wanted;
  wanted.name = body.words("name", 1, max_user_name);
  wanted.display_name = body.words("display_name", 0, longest_display_name);
  wanted.role = access::role_from(body.one_of("role", account_roles)).value_or(Role::trainee);
  std::string password = body.words("password", access::min_password_length, access::max_password_bytes);
  wanted.password = access::Secret(std::move(password));
  body.finish();
  access::AccessControl& gatehouse = gatehouse_of(tools);
  const access::User user = gatehouse.users.add(wanted);
  audit_in (&gatehouse)(request, "user.add", user.id, user.name + " as " + access::to_text(user.role));
  net::Response response = net::json_response(201, user_json(user));
  response.headers.emplace_back("Location", path + "/" + user.id);
  return response;
}

/// What was changed, without what is secret.
std::string words_of(const access::UserChange& change) {
  std::string words;
  const auto add = [&words](const std::string& word) { words += (words.empty() ? "" : ", ") + word; };
  if (change.display_name) add("name to show");
  if (change.role) add("role " + access::to_text(*change.role));
  if (change.enabled) add(*change.enabled ? "enabled" : "disabled");
  if (change.password) add("password");
  return words;
}

net::Response change(const AccessTools& tools, const net::Request& request) {
  RequestBody body(request);
  access::UserChange wanted;
  wanted.display_name = body.words_or_none("display_name", longest_display_name);
  if (const auto role = body.words_or_none("role", max_user_name)) {
    wanted.role = access::role_from(*role);
    if (!wanted.role) body.one_of("role", account_roles);
  }
  wanted.enabled = body.flag_or_none("enabled");
  wanted.password = password_in(body);
  body.finish();
  access::AccessControl& gatehouse = gatehouse_with(tools, "user");
  const access::User user = gatehouse.users.change(id_in(request, "user"), wanted);
  audit_in (&gatehouse)(request, "user.change", user.id, user.name + ": " + words_of(wanted));
  return net::json_response(200, user_json(user));
}

net::Response remove(const AccessTools& tools, const net::Request& request) {
  access::AccessControl& gatehouse = gatehouse_with(tools, "user");
  const access::User user = gatehouse.users.get(id_in(request, "user"));
  gatehouse.users.remove(user.id);
  audit_in (&gatehouse)(request, "user.remove", user.id, user.name);
  return {204, {}, nullptr, {}};
}

net::Response get(const AccessTools& tools, const net::Request& request) {
  access::AccessControl& gatehouse = gatehouse_with(tools, "user");
  return net::json_response(200, user_json(gatehouse.users.get(id_in(request, "user"))));
}

}  // namespace

void add_user_routes(net::Router& router, const AccessTools& tools) {
  const std::string one = path + "/{id}";
  router.on("GET", path, [tools](const net::Request&) { return list(tools); });
  router.on("POST", path,
            [tools](const net::Request& request) { return patiently([&] { return add(tools, request); }); });
  router.on("GET", one, [tools](const net::Request& request) { return get(tools, request); });
  router.on("PATCH", one, [tools](const net::Request& request) {
    return patiently([&] { return change(tools, request); });
  });
  router.on("DELETE", one, [tools](const net::Request& request) { return remove(tools, request); });
}

}  // namespace ream::api
