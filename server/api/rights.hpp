#pragma once
#include <string>
#include <vector>

#include "net/message.hpp"

namespace ream::api {

/// A set of roles, as bits.
using Roles = unsigned;
inline constexpr Roles operators = 1u << 0, instructors = 1u << 1, trainees = 1u << 2, viewers = 1u << 3;
/// Who teaches; who reams; everybody who is known.
inline constexpr Roles staff = operators | instructors;
inline constexpr Roles reamers = staff | trainees;
inline constexpr Roles known = reamers | viewers;

enum class Door {
  anybody,  ///< without asking who it is
  roles,    ///< whoever has one of the roles
  gauges,   ///< one of the roles, any bearer token, and this machine itself: for programs that watch the
            ///< server
};

/// Who may use one route. Which sessions somebody sees there is a finer matter (visibility.hpp).
struct Right {
  std::string method, pattern;  ///< as added to the router; WebSockets are GET
  Door door = Door::roles;
  Roles who = 0;
};

/// One row for every route of the server. A route without a row is refused to everybody.
const std::vector<Right>& rights();

/// The row of a route; null without one. HEAD is asked as GET.
const Right* right_of(const std::string& method, const std::string& pattern);

/// The bit of a caller's role; 0 for callers that are not known.
Roles role_bit(const std::string& role);

}  // namespace ream::api
