#include "ct/packed_frame.hpp"

#include <algorithm>
#include <cstdint>

namespace ream::ct {
namespace {

constexpr size_t longest_filling = 64;

unsigned byte_at(std::string_view bytes, size_t at) { return static_cast<unsigned char>(bytes[at]); }
unsigned two_at(std::string_view bytes, size_t at) {
  return byte_at(bytes, at) << 8 | byte_at(bytes, at + 1);
}
uint32_t four_at(std::string_view bytes, size_t at) {
  return uint32_t{two_at(bytes, at)} << 16 | two_at(bytes, at + 2);
}

std::string contradiction(bool fits) { return fits ? "" : "their stream contradicts the header"; }

const char* const damaged = "the headers of their stream are damaged";

/// The frame header of JPEG 2000 (SIZ) follows the start at once.
std::string jpeg_2000_problem(std::string_view bytes, int columns, int rows) {
  constexpr size_t header_bytes = 2 + 2 + 38 + 3;
  constexpr unsigned size_marker = 0xff51;
  if (bytes.size() < header_bytes || two_at(bytes, 2) != size_marker) return damaged;
  const uint32_t right = four_at(bytes, 8), bottom = four_at(bytes, 12), left = four_at(bytes, 16),
                 top = four_at(bytes, 20);
  return contradiction(right > left && bottom > top && right - left == static_cast<uint32_t>(columns) &&
                       bottom - top == static_cast<uint32_t>(rows) && two_at(bytes, 40) == 1 &&
                       byte_at(bytes, 43) == 1 && byte_at(bytes, 44) == 1);
}

bool starts_frame(unsigned marker) {
  const bool jpeg = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
  return jpeg || marker == 0xf7;
}

/// Segments up to the frame header (SOF): marker, length, content.
std::string jpeg_problem(std::string_view bytes, int columns, int rows) {
  size_t at = 2;
  while (at + 4 <= bytes.size()) {
    if (byte_at(bytes, at) != 0xff) return damaged;
    const unsigned marker = byte_at(bytes, at + 1);
    if (marker == 0xff) {
      ++at;
      continue;
    }
    const size_t length = two_at(bytes, at + 2);
    if (length < 2 || at + 2 + length > bytes.size()) return damaged;
    if (starts_frame(marker)) {
      constexpr size_t one_component = 11;
      if (length != one_component) return contradiction(false);
      const unsigned precision = byte_at(bytes, at + 4);
      return contradiction(
          precision >= 2 && precision <= 16 && two_at(bytes, at + 5) == static_cast<unsigned>(rows) &&
          two_at(bytes, at + 7) == static_cast<unsigned>(columns) && byte_at(bytes, at + 9) == 1);
    }
    at += 2 + length;
  }
  return damaged;
}

/// Segments, one for each byte of a value, begin where the header says; little endian.
std::string rle_problem(std::string_view bytes, int bytes_a_value) {
  constexpr size_t header_bytes = 64;
  if (bytes.size() < header_bytes) return damaged;
  const auto number = [&](size_t k) {
    return byte_at(bytes, 4 * k) | byte_at(bytes, 4 * k + 1) << 8 | byte_at(bytes, 4 * k + 2) << 16 |
           byte_at(bytes, 4 * k + 3) << 24;
  };
  if (number(0) != static_cast<unsigned>(bytes_a_value)) return contradiction(false);
  size_t last = header_bytes;
  for (size_t k = 1; k <= number(0); ++k) {
    if (number(k) < last || number(k) >= bytes.size() || (k == 1 && number(k) != header_bytes))
      return damaged;
    last = number(k);
  }
  return "";
}

}  // namespace

std::string packed_frame_problem(std::string_view bytes, int columns, int rows, int bytes_a_value, bool rle) {
  if (rle) return rle_problem(bytes, bytes_a_value);
  const auto tail = bytes.substr(bytes.size() - std::min(bytes.size(), longest_filling));
  if (tail.find("\xff\xd9") == std::string_view::npos) return "their stream is cut short";
  if (bytes.starts_with("\xff\x4f")) return jpeg_2000_problem(bytes, columns, rows);
  return bytes.starts_with("\xff\xd8") ? jpeg_problem(bytes, columns, rows) : damaged;
}

}  // namespace ream::ct
