#pragma once
#include <string>
#include <string_view>

namespace ream {

/// The text with A to Z as small letters, whatever the locale; other bytes stay.
std::string lower(std::string_view text);

/// Two lower-case digits for every byte.
std::string hex_of(std::string_view bytes);
/// The bytes of what hex_of() gave; empty for what is no hex.
std::string bytes_from_hex(std::string_view hex);

}  // namespace ream
