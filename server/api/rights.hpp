#pragma once
#include <string>
#include <vector>

#include "access/role.hpp"

namespace ream::api {

enum class RouteAccess {
  anybody,     ///< without asking who it is
  roles,       ///< whoever has one of the roles
  monitoring,  ///< one of the roles, any bearer token, and this machine itself: for programs that watch the
               ///< server
};

/// Who may use one route. Which sessions somebody sees there is a finer matter (visibility.hpp).
struct Right {
  std::string method, pattern;  ///< as added to the router; WebSockets are GET
  RouteAccess route_access = RouteAccess::roles;
  access::Roles who = 0;
};

/// One row for every route of the server. A route without a row is refused to everybody.
const std::vector<Right>& rights();

/// The row of a route; null without one. HEAD is asked as GET.
const Right* right_of(const std::string& method, const std::string& pattern);

}  // namespace ream::api
