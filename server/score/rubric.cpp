#include "score/rubric.hpp"

#include <cmath>
#include <rubrics.hpp>
#include <set>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/json.hpp"
#include "core/json_reader.hpp"

namespace ream::score {
namespace {

using nlohmann::json;

constexpr size_t max_curve_points = 50, max_source_bytes = 1000;

std::vector<CurvePoint> curve_from(JsonReader& reader) {
  std::vector<CurvePoint> curve;
  for (JsonReader& entry : reader.objects("curve")) {
    curve.push_back({entry.number("at"), entry.number("points", 0.0, 100.0)});
    entry.finish();
    if (curve.size() > 1 && !(curve.back().at > curve[curve.size() - 2].at))
      entry.refuse("at", "must be greater than in the point before");
  }
  if (curve.size() < 2 || curve.size() > max_curve_points)
    reader.refuse("curve", "needs 2 to " + std::to_string(max_curve_points) + " points");
  return curve;
}

Criterion criterion_from(JsonReader& reader) {
  Criterion c;
  c.metric = reader.text("metric");
  if (reader.has("none") || reader.has("full")) {
    c.ramp = Ramp{reader.number("none"), reader.number("full")};
    if (c.ramp->none == c.ramp->full) reader.refuse("full", "must differ from none");
  }
  if (reader.has("curve")) {
    if (c.ramp) reader.refuse("curve", "stands in place of none and full; give one of them");
    c.curve = curve_from(reader);
  }
  if (reader.has("band")) c.band = band_from_json(reader.object("band"));
  c.weight = reader.number_or("weight", 1.0, 0.0, 1e6);
  c.critical = reader.boolean_or("critical", false);
  c.source = reader.text_or("source", "");
  if (c.source.size() > max_source_bytes) reader.refuse("source", "must not be longer than 1000 bytes");
  reader.finish();
  const bool without_limits = c.judged_by().better == Better::report_only;
  if (!c.ramp && c.curve.empty() && without_limits)
    reader.refuse("metric", "is '" + c.metric +
                                "', which has no limits of its own; give a curve, none and full, or a band");
  if (c.critical && without_limits)
    reader.refuse("critical", "needs limits, and '" + c.metric + "' has none of its own; give a band");
  return c;
}

json criterion_json(const Criterion& c) {
  json value = {{"metric", c.metric}, {"weight", c.weight}};
  if (c.ramp) {
    value["none"] = c.ramp->none;
    value["full"] = c.ramp->full;
  }
  for (const CurvePoint& point : c.curve)
    value["curve"].push_back({{"at", point.at}, {"points", point.points}});
  if (c.band) value["band"] = band_json(*c.band);
  if (c.critical) value["critical"] = true;
  if (!c.source.empty()) value["source"] = c.source;
  return value;
}

}  // namespace

Band Criterion::judged_by() const {
  if (band) return *band;
  const Metric* known = find_metric(metric);
  return known ? known->band : Band{};
}

Rubric load_rubric(const std::filesystem::path& path) {
  return rubric_from_json(read_json_file(path), path.string());
}

Rubric rubric_from_json(const json& value, const std::string& place) {
  JsonReader reader(value, place);
  Rubric rubric;
  rubric.name = reader.text("name");
  if (rubric.name.empty()) reader.refuse("name", "must not be empty");
  rubric.version = static_cast<int>(reader.integer("version", 1, 1'000'000));
  rubric.remark = reader.text_or("remark", "");
  if (reader.has("pass_points")) rubric.pass_points = reader.number("pass_points", 0.0, 100.0);
  rubric.min_measured_percent = reader.number_or("least_said_percent", 50.0, 0.0, 100.0);
  std::set<std::string> metrics;
  for (JsonReader& entry : reader.objects("criteria")) {
    rubric.criteria.push_back(criterion_from(entry));
    if (!metrics.insert(rubric.criteria.back().metric).second)
      entry.refuse("metric", "is '" + rubric.criteria.back().metric + "' a second time");
  }
  reader.finish();
  if (rubric.criteria.empty()) reader.refuse("criteria", "must name at least one metric");
  return rubric;
}

json rubric_json(const Rubric& rubric) {
  json criteria = json::array();
  for (const Criterion& c : rubric.criteria) criteria.push_back(criterion_json(c));
  json value = {{"name", rubric.name},
                {"version", rubric.version},
                {"least_said_percent", rubric.min_measured_percent},
                {"criteria", std::move(criteria)}};
  if (!rubric.remark.empty()) value["remark"] = rubric.remark;
  if (rubric.pass_points) value["pass_points"] = *rubric.pass_points;
  return value;
}

// A hair above, so that what is a tenth but for the sum's own rounding stays one.
double rounded_points(double points) { return std::floor(points * 10.0 + 1e-6) / 10.0; }

uint64_t rubric_hash(const Rubric& rubric) { return hash_text(rubric_json(rubric).dump()); }

const Rubric& standard_rubric() { return standard_rubrics().back(); }

std::span<const Rubric> standard_rubrics() {
  static const std::vector<Rubric> all = [] {
    std::vector<Rubric> versions;
    for (const char* file : {"standard-1.json", "standard.json"})
      versions.push_back(rubric_from_json(parse_json(embedded::rubrics::find(file)), file));
    return versions;
  }();
  return all;
}

}  // namespace ream::score
