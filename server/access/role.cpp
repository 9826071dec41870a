#include "access/role.hpp"

namespace ream::access {

std::string to_text(Role role) {
  switch (role) {
    case Role::viewer:
      return "viewer";
    case Role::trainee:
      return "trainee";
    case Role::instructor:
      return "instructor";
    case Role::operator_:
      return "operator";
  }
  return "viewer";
}

std::optional<Role> role_from(const std::string& text) {
  for (const Role role : {Role::viewer, Role::trainee, Role::instructor, Role::operator_})
    if (text == to_text(role)) return role;
  return std::nullopt;
}

bool may_be_limited(Role of, Role limit) {
  if (of == Role::trainee) return limit == Role::trainee;
  return limit <= of;
}

}  // namespace ream::access
