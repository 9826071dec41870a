#include "net/byte_range.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

namespace ream::net {
namespace {

/// Digits only; a number beyond 64 bits is as good as the largest.
std::optional<uint64_t> number_in(std::string_view text) {
  uint64_t value = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || failed == std::errc::invalid_argument) return std::nullopt;
  return failed == std::errc() ? value : UINT64_MAX;
}

}  // namespace

ByteRange read_range(std::string_view header, uint64_t size) {
  using Answer = ByteRange::Answer;
  constexpr std::string_view unit = "bytes=";
  if (!header.starts_with(unit)) return {};
  const std::string_view range = header.substr(unit.size());
  const size_t dash = range.find('-');
  if (dash == std::string_view::npos) return {};
  const std::string_view first_text = range.substr(0, dash), last_text = range.substr(dash + 1);
  const auto first = number_in(first_text), last = number_in(last_text);
  if (first_text.empty()) {
    if (!last) return {};
    const uint64_t bytes = std::min(*last, size);
    return {bytes > 0 ? Answer::part : Answer::unsatisfiable, size - bytes, bytes};
  }
  if (!first || (!last && !last_text.empty()) || (last && *last < *first)) return {};
  if (*first >= size) return {Answer::unsatisfiable, 0, 0};
  const uint64_t end = last ? std::min(*last, size - 1) + 1 : size;
  return {Answer::part, *first, end - *first};
}

}  // namespace ream::net
