#include "report/metric_tables.hpp"

#include <algorithm>

#include "case/measures.hpp"
#include "core/units.hpp"
#include "report/number_text.hpp"
#include "score/metric_results.hpp"

namespace ream::report {
namespace {

using score::Better;

std::string value_in_words(const score::Metric& metric, double value) {
  switch (metric.style) {
    case score::Style::version: return case_::version_in_words(radians_from_degrees(value));
    case score::Style::inclination: return case_::inclination_in_words(radians_from_degrees(value));
    default: return with_unit(value, metric.unit);
  }
}

std::string planned_in_words(const score::Metric& metric, const Material& material) {
  if (const score::Metric* planned = score::find_metric(metric.planned_by)) {
    const auto value = number_of(material.metrics, planned->key);
    if (value) return value_in_words(*planned, *value);
  }
  // metrics.json of earlier versions does not have it.
  if (metric.key == "reaming_depth_mm" && material.planned_depth_mm > 0.0)
    return with_unit(material.planned_depth_mm, "mm");
  return "";
}

/// Whether it is printed beside another metric, as what was planned.
bool is_beside_another(const score::Metric& metric) {
  const auto all = score::metrics_of(metric.group);
  return std::any_of(all.begin(), all.end(),
                     [&](const score::Metric& each) { return each.planned_by == metric.key; });
}

std::string limit(double value, std::string_view unit) {
  const std::string printed = printed_unit(unit);
  return shortest(value) + (printed.empty() || unit == "deg" ? "" : "\u00a0") + printed;
}

void put_limits(const score::Band& band, std::string_view unit, MetricLine& line) {
  switch (band.better) {
    case Better::less:
      line.pass = "\u2264\u00a0" + limit(band.pass, unit);
      if (band.warn != band.pass) line.warn = "\u2264\u00a0" + limit(band.warn, unit);
      break;
    case Better::more:
      line.pass = "\u2265\u00a0" + limit(band.pass, unit);
      // A limit that only tells something from nothing.
      line.warn = band.warn > 0.0 && band.warn < 1e-3 ? ">\u00a00" : "\u2265\u00a0" + limit(band.warn, unit);
      if (band.warn == band.pass) line.warn.clear();
      break;
    case Better::between: line.pass = shortest(band.low) + " to " + limit(band.pass, unit); break;
    default: break;
  }
}

Mark mark_of(const score::Band& band, const std::optional<double>& value) {
  if (!value) return Mark::missing;
  const auto judged = score::verdict(band, *value);
  if (!judged) return Mark::none;
  if (*judged == score::Verdict::pass) return Mark::pass;
  return *judged == score::Verdict::warn ? Mark::warn : Mark::fail;
}

std::string words_of(score::Evidence evidence) {
  switch (evidence) {
    case score::Evidence::published: return "published";
    case score::Evidence::field: return "common knowledge of the field";
    case score::Evidence::tested: return "computed and tested here";
    default: return "engineering judgement";
  }
}

int footnote(const score::Metric& metric, std::vector<std::string>& sources) {
  std::string words(metric.source);
  const std::string evidence = words_of(metric.evidence);
  if (words != evidence) words += " (" + evidence + ")";
  auto found = std::find(sources.begin(), sources.end(), words);
  if (found == sources.end()) found = sources.insert(sources.end(), words);
  return static_cast<int>(found - sources.begin()) + 1;
}

const score::CriterionScore* criterion_of(const Material& material, std::string_view key) {
  for (const score::CriterionScore& c : material.score.criteria)
    if (c.criterion.metric == key) return &c;
  return nullptr;
}

MetricLine line_of(const score::Metric& metric, const Material& material, std::vector<std::string>& sources) {
  MetricLine line;
  const score::CriterionScore* criterion = criterion_of(material, metric.key);
  const score::Band band = criterion ? criterion->criterion.judged_by() : metric.band;
  const std::optional<double> value = number_of(material.metrics, metric.key);
  line.name = metric.name;
  line.planned = planned_in_words(metric, material);
  if (value) line.value = value_in_words(metric, *value);
  put_limits(band, metric.unit, line);
  line.mark = mark_of(band, value);
  if (criterion) {
    line.critical = criterion->criterion.critical;
    if (criterion->points && criterion->criterion.weight > 0.0)
      line.points = decimal(*criterion->points, 0) + " \u00d7 " + shortest(criterion->criterion.weight);
  }
  line.source = footnote(metric, sources);
  return line;
}

}  // namespace

std::optional<double> number_of(const nlohmann::json& metrics, std::string_view key) {
  const auto found = metrics.find(std::string(key));
  if (found == metrics.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

std::vector<MetricTable> metric_tables(const Material& material, std::vector<std::string>& sources) {
  using Group = std::pair<const char*, score::MetricGroup>;
  std::vector<MetricTable> tables;
  for (const auto& [title, group] :
       {Group{"Alignment", score::MetricGroup::alignment}, Group{"Bone", score::MetricGroup::bone},
        Group{"Handling", score::MetricGroup::handling}}) {
    MetricTable table{title, {}};
    for (const score::Metric& metric : score::metrics_of(group))
      if (!is_beside_another(metric)) table.lines.push_back(line_of(metric, material, sources));
    tables.push_back(std::move(table));
  }
  return tables;
}

std::vector<Fact> metric_meanings(std::vector<std::string>& sources) {
  std::vector<Fact> facts;
  for (const score::Metric& metric : score::metric_catalogue()) {
    const std::string unit = printed_unit(metric.unit);
    facts.push_back({std::string(metric.name) + (unit.empty() ? "" : ", " + unit),
                     std::string(metric.definition) + " Confidence: " + std::string(metric.confidence) +
                         ". Source " + std::to_string(footnote(metric, sources)) + "."});
  }
  return facts;
}

std::vector<Fact> missing_metrics(const nlohmann::json& metrics) {
  std::vector<Fact> facts;
  for (const score::Metric& metric : score::metric_catalogue()) {
    if (number_of(metrics, metric.key)) continue;
    const std::string reason = score::missing_reason(metrics, metric.key);
    const auto same =
        std::find_if(facts.begin(), facts.end(), [&](const Fact& f) { return f.value == reason; });
    if (same == facts.end())
      facts.push_back({std::string(metric.name), reason});
    else
      same->name += "; " + std::string(metric.name);
  }
  return facts;
}

}  // namespace ream::report
