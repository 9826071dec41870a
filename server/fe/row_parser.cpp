#include "fe/row_parser.hpp"

#include <string.h>

#include <charconv>
#include <cmath>
#include <string_view>

namespace ream::fe {
namespace {

constexpr const char* no_row = "is not four finite numbers 'x y z gray'";

bool separates(char c) { return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r'; }

/// False where a number and its line's end do not follow.
bool read_gray(const char* at, float& gray) {
  bool minus = false;
  const char* digit = at;
  if (*digit == '-') minus = true, ++digit;
  int32_t whole = 0;
  const char* const first = digit;
  while (*digit >= '0' && *digit <= '9' && digit - first < 7) whole = 10 * whole + (*digit++ - '0');
  if (digit != first && (separates(*digit) || *digit == '\n')) {
    gray = static_cast<float>(minus ? -whole : whole);
    at = digit;
  } else {
    double value = 0.0;
    const auto parsed = std::from_chars(at, at + 64, value);
    gray = static_cast<float>(value);
    if (parsed.ec != std::errc() || !std::isfinite(gray)) return false;
    at = parsed.ptr;
  }
  while (separates(*at)) ++at;
  return *at == '\n';
}

}  // namespace

std::optional<RowFault> RowParser::parse(const char* begin, const char* end, uint64_t byte,
                                         std::vector<RowRecord>& rows, std::vector<uint64_t>* bytes_of_rows) {
  for (const char* at = begin; at < end;) {
    const char* const stop = static_cast<const char*>(::rawmemchr(at, '\n'));
    const char* first = at;
    while (separates(*first)) ++first;
    const uint64_t line_byte = byte + static_cast<uint64_t>(at - begin);
    at = stop + 1;
    if (first == stop) continue;
    std::optional<std::string> why;
    if (*first == '#') {
      why = comment(first, stop);
    } else {
      RowRecord record;
      why = row(first, line_byte, record);
      if (!why) {
        rows.push_back(record);
        if (bytes_of_rows != nullptr) bytes_of_rows->push_back(line_byte);
      }
    }
    if (why) return RowFault{line_byte, *why};
  }
  return {};
}

std::optional<std::string> RowParser::row(const char* at, uint64_t byte, RowRecord& record) {
  for (size_t k = 0; k < 3; ++k) {
    while (separates(*at)) ++at;
    const auto place = places[k].read(at, byte);
    if (!place && places[k].full())
      return std::string("more than 65,535 different ") + "xyz"[k] +
             " so far; the rows are on no regular grid";
    if (!place) return no_row;
    record.place[k] = *place;
  }
  while (separates(*at)) ++at;
  if (!read_gray(at, record.gray)) return no_row;
  gray.add(record.gray);
  return {};
}

std::optional<std::string> RowParser::comment(const char* at, const char* end) {
  const std::string_view words(at, static_cast<size_t>(end - at)), key = "# spacing_mm";
  if (!words.starts_with(key)) return {};
  Vec3 spacing;
  at += key.size();
  for (int k = 0; k < 3; ++k) {
    while (at < end && separates(*at)) ++at;
    const auto parsed = std::from_chars(at, end, spacing[k]);
    if (parsed.ec != std::errc() || !(spacing[k] > 0.0) || !std::isfinite(spacing[k]))
      return "'# spacing_mm' needs three positive numbers";
    at = parsed.ptr;
  }
  spacing_mm = spacing;
  return {};
}

}  // namespace ream::fe
