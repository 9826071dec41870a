#pragma once
#include <array>
#include <optional>
#include <string>

namespace ream::access {

/// What somebody may do, from least to most. A viewer only watches.
enum class Role { viewer, trainee, instructor, operator_ };

/// The words of the API and the database.
inline constexpr std::array<const char*, 4> role_names{"viewer", "trainee", "instructor", "operator"};

inline std::string to_text(Role role) { return role_names[static_cast<size_t>(role)]; }

/// Empty for other words.
inline std::optional<Role> role_from(const std::string& text) {
  for (size_t i = 0; i < role_names.size(); ++i)
    if (text == role_names[i]) return static_cast<Role>(i);
  return std::nullopt;
}

/// Whether a token of somebody with role `of` may be limited to `limit`. A trainee's cannot become a
/// viewer's: viewers see sessions of all.
inline bool may_be_limited(Role of, Role limit) {
  return of == Role::trainee ? limit == Role::trainee : limit <= of;
}

/// A set of roles, as bits.
using Roles = unsigned;
inline constexpr Roles operators = 1u << 0, instructors = 1u << 1, trainees = 1u << 2, viewers = 1u << 3;
/// Who teaches; who reams; everybody who is known.
inline constexpr Roles staff = operators | instructors;
inline constexpr Roles reamers = staff | trainees;
inline constexpr Roles all_roles = reamers | viewers;

/// The bit of a role by its word; 0 for others.
inline Roles role_bit(const std::string& role) {
  if (role == "operator") return operators;
  if (role == "instructor") return instructors;
  if (role == "trainee") return trainees;
  return role == "viewer" ? viewers : 0u;
}

inline bool is_staff(const std::string& role) { return (role_bit(role) & staff) != 0; }
inline bool is_operator(const std::string& role) { return role_bit(role) == operators; }

}  // namespace ream::access
