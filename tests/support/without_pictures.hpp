#pragma once
#include <string>

namespace ream::test {

/// A page without the bytes of the pictures in it, which may spell anything.
inline std::string without_pictures(std::string html) {
  const std::string begin = "base64,";
  for (size_t at = html.find(begin); at != std::string::npos; at = html.find(begin, at + begin.size())) {
    const size_t from = at + begin.size();
    html.erase(from, html.find_first_of("\"')", from) - from);
  }
  return html;
}

}  // namespace ream::test
