#include "api/access_resource.hpp"

#include "access/login_backoff.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "net/problem.hpp"

namespace ream::api {

Audit audit_in(access::AccessControl* gatehouse) {
  if (!gatehouse) return no_audit();
  return [gatehouse](const net::Request& request, const std::string& action, const std::string& object,
                     const std::string& detail) {
    const net::Caller& caller = request.caller;
    gatehouse->audit.note({caller.user_id, caller.name, caller.role, caller.credential, request.peer}, action,
                          object, detail);
  };
}

access::AccessControl& gatehouse_of(const AccessTools& tools) {
  if (!tools.gatehouse)
    throw Error(ErrorKind::unavailable, "this server runs without a database, and has no users");
  return *tools.gatehouse;
}

net::Response patiently(const std::function<net::Response()>& handler) {
  try {
    return handler();
  } catch (const access::TooManyAttempts& busy) {
    throw net::RequestError(429, busy.what(), {}, {{"Retry-After", std::to_string(busy.retry_after_s())}});
  }
}

access::AccessControl& gatehouse_with(const AccessTools& tools, const std::string& what) {
  if (!tools.gatehouse) throw Error(ErrorKind::not_found, "no " + what + " of that id");
  return *tools.gatehouse;
}

const std::string& id_in(const net::Request& request, const std::string& what) {
  const std::string& id = request.parameters.at("id");
  if (!is_name(id)) throw Error(ErrorKind::not_found, "no " + what + " of that id");
  return id;
}

}  // namespace ream::api
