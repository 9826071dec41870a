#pragma once
#include <cstdint>
#include <cstring>
#include <string>

namespace ream::fe {

/// The digits of an id and a comma behind them, to be copied 16 bytes at once and advanced by `length`.
struct alignas(16) IdText {
  char text[15];
  uint8_t length;

  /// Needs id < 1e10.
  void set(uint64_t id) {
    char digits[20];
    char* at = digits + sizeof digits;
    while (id >= 100) {
      at -= 2;
      std::memcpy(at, pairs + 2 * (id % 100), 2);
      id /= 100;
    }
    if (id >= 10) {
      at -= 2;
      std::memcpy(at, pairs + 2 * id, 2);
    } else {
      *--at = static_cast<char>('0' + id);
    }
    length = static_cast<uint8_t>(digits + sizeof digits - at);
    std::memcpy(text, at, length);
    text[length++] = ',';
  }

  /// The text of the number after this one.
  void step(uint64_t next_id) {
    char& last = text[length - 2];
    if (last != '9')
      ++last;
    else
      set(next_id);
  }

  /// Writes up to 16 bytes, of which those before the result count.
  char* append(char* at) const {
    std::memcpy(at, this, 16);
    return at + length;
  }

  static const char pairs[201];
};

/// A coordinate in a line of a mesh file.
struct alignas(16) CoordinateText {
  char text[31] = {};
  uint8_t length = 0;

  /// Rounded to `decimals` (0 to 9), without zeros at the end but for one behind the point.
  static CoordinateText of(double mm, int decimals);
  /// Writes 32 bytes, of which those before the result count.
  char* append(char* at) const {
    std::memcpy(at, this, 32);
    return at + length;
  }
};

/// How many decimals keep first + i * step to the nanometre and, where ten digits are enough for that,
/// exactly.
int decimals_of(double first_mm, double step_mm);

/// Shortest text that reads back as the same double, with a point or an exponent in it.
std::string real_text(double value);

}  // namespace ream::fe
