#include "api/score_stores.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace ream::api {

session::Judge ScoreStores::judge_by(const std::string& rubric, const std::string& benchmark) const {
  const std::string words = rubric.empty() ? "standard" : rubric;
  const size_t at = words.find('@');
  const std::string id = words.substr(0, at);
  session::Judge judge;
  judge.rubric_id = id;
  const std::vector<std::string> known = rubrics.ids();
  if (std::find(known.begin(), known.end(), id) == known.end())
    throw Error(ErrorKind::not_found, "no rubric '" + id + "'");
  judge.rubric = at == std::string::npos ? rubrics.get(id) : rubrics.get(id, std::stoi(words.substr(at + 1)));
  if (!benchmark.empty())
    judge.benchmark = std::make_shared<const score::Benchmark>(benchmarks.get(benchmark).benchmark);
  return judge;
}

}  // namespace ream::api
