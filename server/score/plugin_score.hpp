#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/plugin_identity.hpp"

namespace ream::score {

/// What a plug-in makes of a session, beside the rubric.
struct PluginScore {
  double points = 0.0;  ///< 0 to 100
  std::optional<bool> passed;
  std::vector<std::string> lines;  ///< for people
};

/// From now on plugin_score_json() asks it; one a process, the last one. `judge` takes what metrics.json has.
/// To be called before there are sessions.
void offer_plugin_score(PluginIdentity plugin,
                        std::function<PluginScore(const nlohmann::json& metrics)> judge);
std::optional<PluginIdentity> offered_plugin_score();

/// "plugin_score" of proto/score.schema.json. Error invalid_input for what is no score. Only where one was
/// offered.
nlohmann::json plugin_score_json(const nlohmann::json& metrics);

/// Error conflict, naming it, when `score_json`, a session's score.json, has the score of another plug-in
/// than the one that was offered: it would be lost.
void require_same_plugin(const nlohmann::json& score_json);

}  // namespace ream::score
