#pragma once
#include <zlib.h>

#include <array>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "twin/cause_parts.hpp"

namespace ream::test {

/// RFC 4648; what is no letter of it ends the text.
inline std::string from_base64(std::string_view text) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const size_t value = letters.find(c);
    if (value == std::string_view::npos) break;
    bits = bits << 6 | static_cast<uint32_t>(value);
    if ((count += 6) < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<char>(bits >> count));
  }
  return bytes;
}

inline std::string gunzipped(const std::string& packed) {
  z_stream z{};
  if (::inflateInit2(&z, 15 + 16) != Z_OK) throw std::runtime_error("zlib does not begin");
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  z.avail_in = static_cast<uInt>(packed.size());
  std::string bytes;
  std::array<char, 1 << 16> piece;
  int state = Z_OK;
  while (state == Z_OK) {
    z.next_out = reinterpret_cast<Bytef*>(piece.data());
    z.avail_out = piece.size();
    state = ::inflate(&z, Z_NO_FLUSH);
    bytes.append(piece.data(), piece.size() - z.avail_out);
  }
  ::inflateEnd(&z);
  if (state != Z_STREAM_END) throw std::runtime_error("this is no whole gzip stream");
  return bytes;
}

/// What an element of a review file holds, unpacked.
inline std::string held_by(const std::string& page, const std::string& id) {
  const std::string head = "id=\"" + id + "\">";
  const size_t at = page.find(head);
  if (at == std::string::npos) throw std::runtime_error("the page has no " + id);
  return gunzipped(from_base64(std::string_view(page).substr(at + head.size())));
}

/// Parts of a file of parts (proto/causes.md) that begins with `magic`, each with its code first.
inline std::vector<std::string> parts_in(const std::string& file, const std::string& magic) {
  if (file.compare(0, magic.size(), magic) != 0) throw std::runtime_error("it does not begin with " + magic);
  std::vector<std::string> parts;
  for (size_t at = magic.size() + 4; at < file.size();) {
    uint32_t length = 0;
    std::memcpy(&length, file.data() + at, sizeof length);
    parts.push_back(file.substr(at + sizeof length, length));
    at += sizeof length + length;
  }
  return parts;
}

}  // namespace ream::test
