#include "score/plugin_score.hpp"

#include "core/error.hpp"

namespace ream::score {
namespace {

using nlohmann::json;

struct OfferedScore {
  PluginIdentity plugin;
  std::function<PluginScore(const json& metrics)> judge;
};

std::optional<OfferedScore>& offered_score() {
  static std::optional<OfferedScore> score;
  return score;
}

}  // namespace

void offer_plugin_score(PluginIdentity plugin, std::function<PluginScore(const json& metrics)> judge) {
  offered_score() = {std::move(plugin), std::move(judge)};
}

std::optional<PluginIdentity> offered_plugin_score() {
  return offered_score() ? std::optional(offered_score()->plugin) : std::nullopt;
}

json plugin_score_json(const json& metrics) {
  const PluginScore score = offered_score()->judge(metrics);
  const PluginIdentity& plugin = offered_score()->plugin;
  return {{"plugin", {{"name", plugin.name}, {"version", plugin.version}, {"sha256", plugin.sha256}}},
          {"points", score.points},
          {"outcome", score.passed ? json(*score.passed ? "pass" : "fail") : json("undecided")},
          {"lines", score.lines}};
}

void require_same_plugin(const json& score_json) {
  const auto found = score_json.find("plugin_score");
  if (found == score_json.end()) return;
  const json& said = found->at("plugin");
  const PluginIdentity before{said.at("name"), said.at("version"), said.at("sha256")};
  if (offered_plugin_score() != before)
    throw Error(ErrorKind::conflict,
                "its score was made with " + before.in_words() + ": give its file with --plugin");
}

}  // namespace ream::score
