#include "score/rubric.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/json_reader.hpp"

namespace ream::score {
namespace {

using nlohmann::json;

double points_of(const Criterion& c, double value) {
  return 100.0 * std::clamp((value - c.none) / (c.full - c.none), 0.0, 1.0);
}

json or_null(const std::optional<double>& number) { return number ? json(*number) : json(nullptr); }

}  // namespace

Rubric load_rubric(const std::filesystem::path& path) {
  const json value = read_json_file(path);
  JsonReader reader(value, path.string());
  Rubric rubric;
  rubric.name = reader.text("name");
  rubric.version = static_cast<int>(reader.integer("version", 1, 1'000'000));
  for (JsonReader& entry : reader.objects("criteria")) {
    Criterion c;
    c.metric = entry.text("metric");
    c.none = entry.number("none");
    c.full = entry.number("full");
    c.weight = entry.number_or("weight", 1.0, 0.0, 1e6);
    entry.finish();
    if (c.none == c.full) entry.refuse("full", "must differ from none");
    rubric.criteria.push_back(c);
  }
  reader.finish();
  if (rubric.criteria.empty()) reader.refuse("criteria", "must name at least one metric");
  return rubric;
}

Score apply_rubric(const Rubric& rubric, const json& metrics) {
  Score score;
  double sum = 0.0, weights = 0.0;
  for (const Criterion& c : rubric.criteria) {
    const auto found = metrics.find(c.metric);
    if (found == metrics.end() || !(found->is_number() || found->is_null()))
      throw Error(ErrorKind::invalid_input, "rubric '" + rubric.name + "': there is no metric '" + c.metric +
                                                "' with a number; metrics.json names them");
    CriterionScore scored{c.metric, std::nullopt, std::nullopt, c.weight};
    if (found->is_number()) {
      scored.value = found->get<double>();
      scored.points = points_of(c, *scored.value);
      sum += c.weight * *scored.points;
      weights += c.weight;
    }
    score.criteria.push_back(scored);
  }
  if (weights > 0.0) score.points = sum / weights;
  return score;
}

json to_json(const Rubric& rubric, const Score& score) {
  json criteria = json::array();
  for (const CriterionScore& c : score.criteria)
    criteria.push_back({{"metric", c.metric},
                        {"value", or_null(c.value)},
                        {"points", or_null(c.points)},
                        {"weight", c.weight}});
  return {{"rubric", rubric.name},
          {"version", rubric.version},
          {"points", or_null(score.points)},
          {"criteria", std::move(criteria)}};
}

}  // namespace ream::score
