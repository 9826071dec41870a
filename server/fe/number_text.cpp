#include "fe/number_text.hpp"

#include <charconv>
#include <cmath>

namespace ream::fe {
namespace {

constexpr int min_decimals = 3, nanometre_decimals = 6, max_decimals = 9;
constexpr double powers[] = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};

bool exact_with(double value, int decimals) {
  const double scaled = value * powers[decimals];
  return std::abs(scaled - std::nearbyint(scaled)) < 1e-15 * std::abs(scaled) + 1e-6;
}

}  // namespace

const char IdText::pairs[201] =
    "0001020304050607080910111213141516171819202122232425262728293031323334353637383940414243444546474849"
    "5051525354555657585960616263646566676869707172737475767778798081828384858687888990919293949596979899";

CoordinateText CoordinateText::of(double mm, int decimals) {
  CoordinateText result;
  auto scaled = static_cast<int64_t>(std::llround(mm * powers[decimals]));
  char* at = result.text;
  if (scaled < 0) {
    *at++ = '-';
    scaled = -scaled;
  }
  const auto unit = static_cast<int64_t>(powers[decimals]);
  at = std::to_chars(at, result.text + 20, scaled / unit).ptr;
  *at++ = '.';
  int64_t rest = scaled % unit;
  for (int64_t place = unit / 10; rest > 0; place /= 10) {
    *at++ = static_cast<char>('0' + rest / place);
    rest %= place;
  }
  if (at[-1] == '.') *at++ = '0';
  result.length = static_cast<uint8_t>(at - result.text);
  return result;
}

int decimals_of(double first_mm, double step_mm) {
  for (int decimals = min_decimals; decimals <= max_decimals; ++decimals)
    if (exact_with(first_mm, decimals) && exact_with(step_mm, decimals)) return decimals;
  // Rounding must stay small beside the voxel too.
  return step_mm < 1e-3 ? max_decimals : nanometre_decimals;
}

std::string real_text(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  std::string result(text, end);
  if (result.find_first_of(".e") == std::string::npos) result += ".0";
  return result;
}

}  // namespace ream::fe
