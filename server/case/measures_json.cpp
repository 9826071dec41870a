#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "case/measures.hpp"
#include "core/units.hpp"

namespace ream::case_ {
using nlohmann::json;
namespace {

json degrees_or_null(const std::optional<double>& rad) {
  return rad ? json(degrees_from_radians(*rad)) : json(nullptr);
}

json number_or_null(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

/// Healthy shoulders; low and high are the range that was seen, or of what counts as centred.
json normal_values() {
  return {{"version_deg",
           {{"mean", -1.23}, {"low", -10.5}, {"high", 9.5}, {"source", "Churchill 2001, 344 scapulae"}}},
          {"inclination_deg",
           {{"mean", 4.2}, {"low", -7.0}, {"high", 15.8}, {"source", "Churchill 2001, 344 scapulae"}}},
          {"subluxation_percent",
           {{"mean", 50.0}, {"low", 45.0}, {"high", 55.0}, {"source", "Walch 1999: 45 to 55 is centred"}}}};
}

std::string in_words(double rad, const char* negative, const char* positive, const char* none) {
  const double tenths = std::floor(std::abs(degrees_from_radians(rad)) * 10.0 + 0.5);
  char number[32];
  std::snprintf(number, sizeof number, "%.1f", tenths / 10.0);
  return std::string(number) + "\u00b0 " + (tenths == 0.0 ? none : rad < 0.0 ? negative : positive);
}

}  // namespace

std::string version_in_words(double version_rad) {
  return in_words(version_rad, "retroversion", "anteversion", "version");
}

std::string inclination_in_words(double inclination_rad) {
  return in_words(inclination_rad, "inferior", "superior", "inclination");
}

json to_json(const Measures& m) {
  json value = {{"version_3d_deg", degrees_or_null(m.version_3d_rad)},
                {"inclination_3d_deg", degrees_or_null(m.inclination_3d_rad)},
                {"version_friedman_deg", degrees_or_null(m.version_friedman_rad)},
                {"inclination_friedman_deg", degrees_or_null(m.inclination_friedman_rad)},
                {"subluxation_percent", number_or_null(m.subluxation_percent)},
                {"subluxation_glenoid_percent", number_or_null(m.subluxation_glenoid_percent)},
                {"biconcavity", nullptr},
                {"normal", normal_values()},
                {"missing", m.missing},
                {"words", {{"version", nullptr}, {"inclination", nullptr}}}};
  if (const auto& b = m.biconcavity)
    value["biconcavity"] = {{"paleo_version_deg", degrees_from_radians(b->paleo_version_rad)},
                            {"neo_version_deg", degrees_from_radians(b->neo_version_rad)},
                            {"intermediate_version_deg", degrees_from_radians(b->intermediate_version_rad)},
                            {"between_deg", degrees_from_radians(b->between_rad)}};
  if (m.version_3d_rad) value["words"]["version"] = version_in_words(*m.version_3d_rad);
  if (m.inclination_3d_rad) value["words"]["inclination"] = inclination_in_words(*m.inclination_3d_rad);
  return value;
}

}  // namespace ream::case_
