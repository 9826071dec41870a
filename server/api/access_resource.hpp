#pragma once
#include <functional>
#include <string>

#include "access/access_control.hpp"
#include "api/audit.hpp"
#include "api/authorizer.hpp"
#include "net/router.hpp"

namespace ream::api {

/// What the resources of access share. All outlive the router.
struct AccessTools {
  const Authorizer& authorizer;
  access::AccessControl* gatehouse;  ///< null: there are never users
  /// Error not_found unless there is such a session.
  std::function<void(const std::string& id)> require_session;
};

/// Who one is, logging in and out: /api/v1/login and below.
void add_login_routes(net::Router& router, const AccessTools& tools);
/// /api/v1/users.
void add_user_routes(net::Router& router, const AccessTools& tools);
/// /api/v1/tokens and /api/v1/links.
void add_token_routes(net::Router& router, const AccessTools& tools);
void add_link_routes(net::Router& router, const AccessTools& tools);
/// GET /api/v1/audit.
void add_audit_routes(net::Router& router, const AccessTools& tools);

/// Keeps changes in the gatehouse's audit log.
Audit audit_in(access::AccessControl* gatehouse);

/// The gatehouse. Error unavailable for a server without a database.
access::AccessControl& gatehouse_of(const AccessTools& tools);
/// The same to find one user, token or link in (`what`). Error not_found for a server without a database.
access::AccessControl& gatehouse_with(const AccessTools& tools, const std::string& what);

/// Runs a handler; what is asked too often becomes 429 with Retry-After.
net::Response patiently(const std::function<net::Response()>& handler);

/// The id in the path; Error not_found for what can be none.
const std::string& id_in(const net::Request& request, const std::string& what);

}  // namespace ream::api
