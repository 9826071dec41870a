#pragma once
#include <optional>
#include <string>

namespace ream::access {

/// What somebody may do, from least to most. A viewer only watches.
enum class Role { viewer, trainee, instructor, operator_ };

/// The word of the API and the database: "operator", "instructor", "trainee", "viewer".
std::string to_text(Role role);
/// Empty for other words.
std::optional<Role> role_from(const std::string& text);

/// Whether a token of somebody with role `of` may be limited to `limit`. A trainee's cannot become a
/// viewer's: viewers see sessions of all.
bool may_be_limited(Role of, Role limit);

}  // namespace ream::access
