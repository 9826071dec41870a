#include "case/calibration.hpp"

#include <nlohmann/json.hpp>

#include "core/json_reader.hpp"

namespace ream::case_ {
namespace {

constexpr double least_slope = 1e-6, largest = 1e6;

}  // namespace

Calibration calibration_from_json(const nlohmann::json& value, const std::string& place) {
  JsonReader reader(value, place);
  Calibration c;
  c.intercept_mg_cc = reader.number("intercept_mg_cc", -largest, largest);
  c.slope_mg_cc_per_hu = reader.number("slope_mg_cc_per_hu", least_slope, largest);
  c.threshold_hu = reader.number("threshold_hu");
  c.scanner = reader.text_or("scanner", c.scanner);
  c.ash_law = reader.text_or("ash_law", c.ash_law);
  c.ash_intercept_g_cc = reader.number_or("ash_intercept_g_cc", c.ash_intercept_g_cc, -10.0, 10.0);
  c.ash_slope = reader.number_or("ash_slope", c.ash_slope, least_slope, largest);
  c.ash_per_apparent = reader.number_or("ash_per_apparent", c.ash_per_apparent, 0.01, 1.0);
  reader.finish();
  return c;
}

nlohmann::json to_json(const Calibration& c) {
  nlohmann::json value = {{"intercept_mg_cc", c.intercept_mg_cc},
                          {"slope_mg_cc_per_hu", c.slope_mg_cc_per_hu},
                          {"threshold_hu", c.threshold_hu},
                          {"ash_law", c.ash_law},
                          {"ash_intercept_g_cc", c.ash_intercept_g_cc},
                          {"ash_slope", c.ash_slope},
                          {"ash_per_apparent", c.ash_per_apparent}};
  if (!c.scanner.empty()) value["scanner"] = c.scanner;
  return value;
}

}  // namespace ream::case_
