#include "support/identifier_search.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <set>
#include <stdexcept>

#include "core/file.hpp"

namespace ream::test {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

constexpr int max_depth = 4, raw_deflate = -15, gzip_or_zlib = 47;
constexpr size_t shortest_base64 = 12;  // less is found in any picture
constexpr size_t piece_bytes = 1 << 16, max_unpacked_bytes = size_t{1} << 28;

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
  return text;
}

/// What both orders of bytes have in common.
std::string utf16(const std::string& text) {
  std::string wide;
  for (const char c : text) wide += {c, '\0'};
  wide.pop_back();
  return wide;
}

std::string url_encoded(const std::string& text) {
  std::string encoded;
  for (const char c : text) {
    char code[8];
    std::snprintf(code, sizeof code, "%%%02x", static_cast<unsigned char>(c));
    const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '_';
    encoded += plain ? std::string{c} : code;
  }
  return encoded;
}

/// What of the text's Base64 does not depend on what is before and behind it, when `offset` bytes are before.
std::string base64_core(const std::string& text, size_t offset) {
  constexpr auto alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"sv;
  std::string encoded;
  for (size_t at = (3 - offset) % 3; at + 3 <= text.size(); at += 3) {
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k) bits = bits << 8 | static_cast<unsigned char>(text[at + k]);
    for (int shift = 18; shift >= 0; shift -= 6) encoded += alphabet[bits >> shift & 63];
  }
  return encoded;
}

std::string inflated(std::string_view packed, int window_bits) {
  z_stream stream{};
  if (::inflateInit2(&stream, window_bits) != Z_OK) throw std::runtime_error("zlib cannot begin");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string plain;
  std::vector<char> piece(piece_bytes);
  int state = Z_OK;
  while (state == Z_OK && plain.size() < max_unpacked_bytes) {
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(piece.size());
    state = ::inflate(&stream, Z_NO_FLUSH);
    plain.append(piece.data(), piece.size() - stream.avail_out);
  }
  ::inflateEnd(&stream);
  return plain;
}

std::string decompressed(std::string_view packed) {
  ZSTD_DStream* stream = ZSTD_createDStream();
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  std::string plain;
  std::vector<char> piece(piece_bytes);
  size_t more = 1;
  while (more != 0 && plain.size() < max_unpacked_bytes) {
    ZSTD_outBuffer out{piece.data(), piece.size(), 0};
    more = ZSTD_decompressStream(stream, &out, &in);
    plain.append(piece.data(), out.pos);
    if (ZSTD_isError(more) || (out.pos == 0 && in.pos == in.size)) break;
  }
  ZSTD_freeDStream(stream);
  return plain;
}

/// What is packed at that place; empty for nothing.
std::string unpacked_at(std::string_view bytes, size_t at) {
  const std::string_view rest = bytes.substr(at);
  if (rest.starts_with("\x28\xb5\x2f\xfd"sv)) return decompressed(rest);
  if (rest.starts_with("\x1f\x8b\x08"sv)) return inflated(rest, gzip_or_zlib);
  if (rest.starts_with("stream\n"sv)) return inflated(rest.substr(7), gzip_or_zlib);
  if (rest.starts_with("stream\r\n"sv)) return inflated(rest.substr(8), gzip_or_zlib);
  if (rest.starts_with("IDAT"sv)) return inflated(rest.substr(4), gzip_or_zlib);
  if (!rest.starts_with("PK\x03\x04"sv) || rest.size() < 30) return {};
  uint16_t name = 0, extra = 0, method = 0;
  std::memcpy(&method, rest.data() + 8, 2);
  std::memcpy(&name, rest.data() + 26, 2);
  std::memcpy(&extra, rest.data() + 28, 2);
  const size_t begin = size_t{30} + name + extra;
  return method == 8 && begin < rest.size() ? inflated(rest.substr(begin), raw_deflate) : std::string();
}

/// Where something packed may begin.
std::vector<size_t> packed_places(std::string_view bytes) {
  std::vector<size_t> places;
  for (const std::string_view mark :
       {"\x28\xb5\x2f\xfd"sv, "\x1f\x8b\x08"sv, "stream\n"sv, "stream\r\n"sv, "IDAT"sv, "PK\x03\x04"sv})
    for (size_t at = bytes.find(mark); at != std::string_view::npos; at = bytes.find(mark, at + 1))
      places.push_back(at);
  return places;
}

}  // namespace

void IdentifierSearch::add(const std::string& name, const std::string& word) {
  const std::string small = lower(word);
  std::vector<std::string>& forms = forms_[name];
  forms = {small, utf16(small), url_encoded(small)};
  for (size_t offset = 0; offset < 3; ++offset)
    if (const std::string core = base64_core(word, offset); core.size() >= shortest_base64)
      forms.push_back(lower(core));
}

std::vector<std::string> IdentifierSearch::found_in(const std::string& bytes) const {
  std::set<std::string> found;
  const auto look = [&](const auto& self, const std::string& text, int depth) -> void {
    const std::string small = lower(text);
    for (const auto& [name, forms] : forms_)
      if (std::any_of(forms.begin(), forms.end(), [&](const std::string& form) {
            return ::memmem(small.data(), small.size(), form.data(), form.size()) != nullptr;
          }))
        found.insert(name);
    if (depth == max_depth) return;
    for (const size_t at : packed_places(text))
      if (const std::string inner = unpacked_at(text, at); !inner.empty()) self(self, inner, depth + 1);
  };
  look(look, bytes, 0);
  return {found.begin(), found.end()};
}

std::vector<std::string> IdentifierSearch::found_below(const fs::path& folder) const {
  std::vector<std::string> findings;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string path = entry.path().lexically_relative(folder).string();
    for (const std::string& name : found_in(path)) findings.push_back(path + ": " + name + " (its name)");
    if (!entry.is_regular_file()) continue;
    for (const std::string& name : found_in(read_text_file(entry.path())))
      findings.push_back(path + ": " + name);
  }
  return findings;
}

}  // namespace ream::test
