#include "study/feel_trials.hpp"

#include <set>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "study/seeded_draws.hpp"

namespace ream::study {
using nlohmann::json;

json to_json(const FeelTrials& trials) {
  return {{"comparisons", trials.comparisons}, {"trials_per_comparison", trials.trials_per_comparison}};
}

FeelTrials feel_trials_from(const json& value) {
  FeelTrials trials;
  trials.trials_per_comparison = value.value("trials_per_comparison", trials.trials_per_comparison);
  if (value.contains("comparisons")) {
    value.at("comparisons").get_to(trials.comparisons);
  } else {
    for (const case_::PlateComparison& comparison : case_::plate_comparisons())
      trials.comparisons.push_back(comparison.id);
  }
  std::set<std::string> seen;
  for (const std::string& id : trials.comparisons)
    if (!seen.insert(id).second)
      throw Error(ErrorKind::invalid_input, "feel.comparisons: '" + id + "' comes twice");
  return trials;
}

std::vector<FeelTrial> trials_for(const FeelTrials& trials, const std::string& seed,
                                  const std::string& code) {
  std::vector<FeelTrial> order;
  for (const std::string& id : trials.comparisons)
    for (int i = 0; i < trials.trials_per_comparison; ++i)
      order.push_back({0, 0, case_::find_plate_comparison(id), i % 2 == 0});
  SeededDraws(hash_text(code, hash_text(seed))).shuffle(order);
  for (size_t i = 0; i < order.size(); ++i) {
    order[i].number = static_cast<int>(i) + 1;
    order[i].of = static_cast<int>(order.size());
  }
  return order;
}

}  // namespace ream::study
