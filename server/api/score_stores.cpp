#include "api/score_stores.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "net/problem.hpp"

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

score::Rubric requested_rubric(const nlohmann::json& body) {
  score::Rubric rubric = score::rubric_from_json(body, "the request body");
  for (size_t i = 0; i < rubric.criteria.size(); ++i)
    if (const std::string& metric = rubric.criteria[i].metric; !score::find_metric(metric))
      throw net::RequestError(422,
                              "there is no metric '" + metric + "'; choose one of those that scores have",
                              {{"#/criteria/" + std::to_string(i) + "/metric", "is no metric"}});
  return rubric;
}

}  // namespace ream::api
