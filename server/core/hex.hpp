#pragma once
#include <string>
#include <string_view>

namespace ream {

/// Two lower-case digits for every byte.
std::string hex_of(std::string_view bytes);
/// The bytes of what hex_of() gave; empty for what is no hex.
std::string bytes_from_hex(std::string_view hex);

}  // namespace ream
