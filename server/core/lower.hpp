#pragma once
#include <string>
#include <string_view>

namespace ream {

/// The text with A to Z as small letters, whatever the locale; other bytes stay.
inline std::string lower(std::string_view text) {
  std::string small(text);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small;
}

}  // namespace ream
