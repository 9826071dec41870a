#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace ream {

/// The text with A to Z as small letters, whatever the locale; other bytes stay.
std::string lower(std::string_view text);

/// Foreign words on one line: control characters become blanks; what is longer than `max_bytes` ends in
/// "...".
std::string one_line(std::string text, size_t max_bytes);

/// Two lower-case digits for every byte.
std::string hex_of(std::string_view bytes);
/// The bytes of what hex_of() gave; empty for what is no hex.
std::string bytes_from_hex(std::string_view hex);

/// Of UTF-8: characters, not bytes.
size_t characters(const std::string& text);

/// The JSON pointer of a key as a URI fragment (RFC 6901): '~' and '/' of the key are escaped.
std::string pointer_to(const std::string& key);

/// Whether `text` is an id as cases and scripts have: [a-z0-9-], 1 to 64 long.
bool is_name(const std::string& text);

/// RFC 4648, with padding.
std::string base64(std::span<const std::byte> bytes);

}  // namespace ream
