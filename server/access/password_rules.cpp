#include "access/password_rules.hpp"

#include <algorithm>
#include <optional>

#include "core/error.hpp"

namespace ream::access {
namespace {

size_t bytes_of_character(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return 2;
  if (first >= 0xe0 && first < 0xf0) return 3;
  return first >= 0xf0 && first < 0xf5 ? 4 : 0;
}

/// None when it is not UTF-8.
std::optional<size_t> characters_of(const std::string& text) {
  size_t count = 0;
  for (size_t at = 0; at < text.size(); ++count) {
    const size_t bytes = bytes_of_character(static_cast<unsigned char>(text[at]));
    if (bytes == 0 || at + bytes > text.size()) return std::nullopt;
    const auto begin = text.begin() + static_cast<std::ptrdiff_t>(at);
    if (!std::all_of(begin + 1, begin + static_cast<std::ptrdiff_t>(bytes),
                     [](unsigned char byte) { return (byte & 0xc0) == 0x80; }))
      return std::nullopt;
    at += bytes;
  }
  return count;
}

}  // namespace

void require_good_password(const Secret& password) {
  if (password.reveal().size() > longest_password_bytes)
    throw Error(ErrorKind::invalid_input,
                "a password has at most " + std::to_string(longest_password_bytes) + " bytes");
  const auto characters = characters_of(password.reveal());
  if (!characters) throw Error(ErrorKind::invalid_input, "a password must be UTF-8 text");
  if (*characters < shortest_password)
    throw Error(ErrorKind::invalid_input,
                "a password has at least " + std::to_string(shortest_password) + " characters");
}

}  // namespace ream::access
