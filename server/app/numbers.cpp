#include "app/numbers.hpp"

#include <charconv>
#include <cmath>

#include "core/error.hpp"

namespace ream::app {

std::vector<double> parse_numbers(const std::string& text, size_t count, const std::string& option) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    double value = 0.0;
    const auto [rest, failed] = std::from_chars(at, end, value);
    if (failed != std::errc{} || !std::isfinite(value) || (rest != end && *rest != ',')) break;
    numbers.push_back(value);
    at = rest;
    if (at != end && ++at == end) break;
  }
  if (at != end || numbers.size() != count || text.back() == ',')
    throw Error(ErrorKind::usage, option + " '" + text + "' " +
                                      (count == 1 ? "is not a finite number"
                                                  : "must be " + std::to_string(count) +
                                                        " finite numbers separated by commas"));
  return numbers;
}

std::string rounded(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

}  // namespace ream::app
