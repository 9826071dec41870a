#include "score/metric_catalogue.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "score/band_json.hpp"
#include "score/metric_groups.hpp"

namespace ream::score {
using nlohmann::json;

std::span<const Metric> metric_catalogue() {
  static const std::vector<Metric> all = [] {
    std::vector<Metric> metrics;
    for (const auto group : {alignment_metrics(), bone_metrics(), handling_metrics()})
      metrics.insert(metrics.end(), group.begin(), group.end());
    return metrics;
  }();
  return all;
}

const Metric* find_metric(std::string_view key) {
  const auto all = metric_catalogue();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Metric& m) { return m.key == key; });
  return found == all.end() ? nullptr : &*found;
}

std::optional<Verdict> verdict(const Band& band, double value) {
  switch (band.better) {
    case Better::report_only:
      return std::nullopt;
    case Better::less:
      return value <= band.pass ? Verdict::pass : value <= band.warn ? Verdict::warn : Verdict::fail;
    case Better::more:
      return value >= band.pass ? Verdict::pass : value >= band.warn ? Verdict::warn : Verdict::fail;
    case Better::between:
      return value >= band.low && value <= band.pass ? Verdict::pass : Verdict::warn;
  }
  return std::nullopt;
}

std::string_view to_text(Evidence evidence) {
  constexpr std::string_view texts[] = {"S", "M", "E", "T"};
  return texts[static_cast<size_t>(evidence)];
}

std::string_view to_text(Verdict verdict) {
  constexpr std::string_view texts[] = {"pass", "warn", "fail"};
  return texts[static_cast<size_t>(verdict)];
}

json catalogue_json() {
  json list = json::array();
  for (const Metric& m : metric_catalogue())
    list.push_back({{"key", m.key},
                    {"name", m.name},
                    {"unit", m.unit},
                    {"definition", m.definition},
                    {"source", m.source},
                    {"evidence", to_text(m.evidence)},
                    {"confidence", m.confidence},
                    {"band", band_json(m.band)},
                    {"live", m.live}});
  return list;
}

}  // namespace ream::score
