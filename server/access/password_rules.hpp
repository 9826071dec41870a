#pragma once
#include <cstddef>

#include "access/secret.hpp"

namespace ream::access {

inline constexpr size_t shortest_password = 10;  ///< characters
inline constexpr size_t longest_password_bytes = 1000;

/// Error invalid_input, without a word of the password, unless it is UTF-8 of the right length.
void require_good_password(const Secret& password);

}  // namespace ream::access
