#include "score/group_cut_json.hpp"

#include <functional>
#include <optional>

#include "core/error.hpp"
#include "score/benchmark.hpp"

namespace ream::score {
namespace {

using nlohmann::json;
using Value = std::function<std::optional<double>(const MeasuredSession&)>;

std::vector<double> said(const std::vector<MeasuredSession>& sessions, const Value& value) {
  std::vector<double> values;
  for (const MeasuredSession& session : sessions)
    if (const auto number = value(session)) values.push_back(*number);
  return values;
}

json cut_json(const std::string& of, const std::vector<double>& novices, const std::vector<double>& experts,
              Density density) {
  try {
    const GroupCut cut = contrasting_groups(novices, experts, density);
    return {{"of", of},
            {"density", to_text(cut.density)},
            {"cut", cut.cut},
            {"experts_higher", cut.experts_higher},
            {"novices", cut.novices},
            {"novice_mean", cut.novice_mean},
            {"novice_sd", cut.novice_sd},
            {"novices_passing", cut.novices_passing},
            {"expected_novices_passing", cut.expected_novices_passing},
            {"experts", cut.experts},
            {"expert_mean", cut.expert_mean},
            {"expert_sd", cut.expert_sd},
            {"experts_failing", cut.experts_failing},
            {"expected_experts_failing", cut.expected_experts_failing}};
  } catch (const Error& e) {
    return {{"of", of}, {"error", e.what()}};
  }
}

}  // namespace

json group_cuts_json(const std::vector<MeasuredSession>& novices, const std::vector<MeasuredSession>& experts,
                     const Rubric& rubric, Density density) {
  const Value points = [&](const MeasuredSession& session) {
    return apply_rubric(rubric, session.metrics).points;
  };
  json cuts = json::array({cut_json("points", said(novices, points), said(experts, points), density)});
  for (const Metric& metric : metric_catalogue()) {
    if (!aim_of(metric)) continue;
    const std::string key(metric.key);
    const Value value = [&](const MeasuredSession& session) -> std::optional<double> {
      const auto found = session.metrics.find(key);
      if (found == session.metrics.end() || !found->is_number()) return std::nullopt;
      return found->get<double>();
    };
    const auto of_novices = said(novices, value), of_experts = said(experts, value);
    if (!of_novices.empty() && !of_experts.empty())
      cuts.push_back(cut_json(key, of_novices, of_experts, density));
  }
  return cuts;
}

Density density_from_text(const std::string& text) {
  for (const Density density : {Density::normal, Density::kernel})
    if (text == to_text(density)) return density;
  throw Error(ErrorKind::invalid_input, "density '" + text + "' is neither normal nor kernel");
}

}  // namespace ream::score
