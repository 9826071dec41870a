#include "report/number_text.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "core/json.hpp"

namespace ream::report {
namespace {

constexpr std::string_view minus = "\u2212";

std::string with_true_minus(std::string text) {
  if (text.starts_with('-')) text.replace(0, 1, minus);
  return text;
}

/// Decimals that a unit deserves.
int decimals_of(std::string_view unit) {
  if (unit == "mm") return 2;
  if (unit == "mm2" || unit == "mm3" || unit == "%") return 0;
  if (unit == "") return 2;
  return 1;
}

}  // namespace

std::string decimal(double value, int decimals) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  std::string words = text.data();
  if (words.find_first_of("123456789") == std::string::npos && words.starts_with('-')) words.erase(0, 1);
  return with_true_minus(words);
}

std::string shortest(double value) {
  std::string text = nlohmann::json(value).dump();
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return with_true_minus(text);
}

std::string printed_unit(std::string_view unit) {
  if (unit == "mm2") return "mm\u00b2";
  if (unit == "mm3") return "mm\u00b3";
  if (unit == "deg") return "\u00b0";
  return std::string(unit);
}

std::string with_unit(double value, std::string_view unit) {
  const bool count = unit.empty() && value == std::floor(value);
  const std::string number = decimal(value, count ? 0 : decimals_of(unit));
  const std::string printed = printed_unit(unit);
  if (printed.empty()) return number;
  return number + (unit == "deg" ? "" : "\u00a0") + printed;
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(std::floor(seconds + 0.5));
  if (whole < 120) return decimal(seconds, seconds < 10.0 ? 1 : 0) + "\u00a0s";
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%ld\u00a0min %02ld\u00a0s", whole / 60, whole % 60);
  return text.data();
}

std::string date_text(const std::string& utc) {
  constexpr std::array<const char*, 12> months = {"January",   "February", "March",    "April",
                                                  "May",       "June",     "July",     "August",
                                                  "September", "October",  "November", "December"};
  int year = 0, month = 0, day = 0, hour = 0, minute = 0;
  if (std::sscanf(utc.c_str(), "%4d-%2d-%2dT%2d:%2d", &year, &month, &day, &hour, &minute) != 5 ||
      month < 1 || month > 12)
    return utc;
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%d %s %d, %02d:%02d UTC", day,
                months[static_cast<size_t>(month - 1)], year, hour, minute);
  return text.data();
}

}  // namespace ream::report
