#include "core/utc.hpp"

#include <ctime>

#include "core/error.hpp"

namespace ream {
namespace {

constexpr const char* format = "%Y-%m-%dT%H:%M:%SZ";

}  // namespace

WallClock machine_clock() {
  return [] { return std::chrono::system_clock::now(); };
}

std::string utc_text(UtcMoment moment) {
  const std::time_t time = std::chrono::system_clock::to_time_t(moment);
  std::tm parts{};
  gmtime_r(&time, &parts);
  char text[32];
  std::strftime(text, sizeof text, format, &parts);
  return text;
}

UtcMoment utc_moment(const std::string& text) {
  std::tm parts{};
  const char* end = ::strptime(text.c_str(), format, &parts);
  if (end == nullptr || *end != '\0' || text.find('\0') != std::string::npos)
    throw Error(ErrorKind::invalid_input,
                "'" + text + "' is no moment; write it as \"2026-01-31T12:00:00Z\"");
  const UtcMoment moment = std::chrono::system_clock::from_time_t(::timegm(&parts));
  if (utc_text(moment) != text)  // the 31st of February
    throw Error(ErrorKind::invalid_input, "there is no moment '" + text + "'");
  return moment;
}

}  // namespace ream
