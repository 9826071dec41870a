#include "core/timing_json.hpp"

#include <array>
#include <string>

#include "core/json.hpp"

namespace ream {
namespace {

struct TimingFigure {
  const char* name;
  double TimingSummary::*value;
};
constexpr std::array timing_figures{
    TimingFigure{"mean", &TimingSummary::mean_us}, TimingFigure{"p50", &TimingSummary::p50_us},
    TimingFigure{"p99", &TimingSummary::p99_us}, TimingFigure{"p999", &TimingSummary::p999_us},
    TimingFigure{"max", &TimingSummary::max_us}};

}  // namespace

nlohmann::json timing_json(const TimingSummary& times, TimingKeys keys) {
  nlohmann::json json = nlohmann::json::object();
  for (const TimingFigure& figure : timing_figures)
    json[std::string(figure.name) + (keys == TimingKeys::bare ? "" : "_us")] = times.*figure.value;
  return json;
}

TimingSummary timing_from(const nlohmann::json& times) {
  TimingSummary summary;
  for (const TimingFigure& figure : timing_figures) summary.*figure.value = times.value(figure.name, 0.0);
  return summary;
}

}  // namespace ream
