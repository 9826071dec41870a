#include "core/timing_json.hpp"

#include <array>
#include <string>

#include "core/json.hpp"

namespace ream {
namespace {

struct Figure {
  const char* name;
  double TimingSummary::*value;
};
constexpr std::array figures{Figure{"mean", &TimingSummary::mean_us}, Figure{"p50", &TimingSummary::p50_us},
                             Figure{"p99", &TimingSummary::p99_us}, Figure{"p999", &TimingSummary::p999_us},
                             Figure{"max", &TimingSummary::max_us}};

}  // namespace

nlohmann::json timing_json(const TimingSummary& times, TimingKeys keys) {
  nlohmann::json json = nlohmann::json::object();
  for (const Figure& figure : figures)
    json[std::string(figure.name) + (keys == TimingKeys::bare ? "" : "_us")] = times.*figure.value;
  return json;
}

TimingSummary timing_from(const nlohmann::json& times) {
  TimingSummary summary;
  for (const Figure& figure : figures) summary.*figure.value = times.value(figure.name, 0.0);
  return summary;
}

}  // namespace ream
