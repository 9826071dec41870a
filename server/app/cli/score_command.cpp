#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/data_folder.hpp"
#include "app/recorded_session.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "score/rubric_score.hpp"

namespace ream::app {
namespace {

struct Options {
  std::vector<std::string> sessions;
  std::string rubric;
};

nlohmann::json scored(const std::string& name, const std::optional<score::Rubric>& rubric,
                      const std::filesystem::path& data) {
  const record::Recording recording(recording_path(name, data), record::Recording::Trust::checked);
  if (const std::string& damage = recording.log().damage(); !damage.empty()) log::warn(damage);
  nlohmann::json json = {{"session", name}, {"metrics", rescored_json(recording)}};
  if (rubric) json["score"] = score::score_json(*rubric, score::apply_rubric(*rubric, json["metrics"]));
  return json;
}

void print(const nlohmann::json& json) {
  std::cout << json.at("session").get<std::string>() << '\n';
  const bool by_rubric = json.contains("score");
  if (!by_rubric) {
    for (const auto& [key, value] : json.at("metrics").items())
      std::cout << "  " << key << "  " << value << '\n';
    return;
  }
  const nlohmann::json& score = json.at("score");
  std::cout << "  " << score.at("rubric").get<std::string>() << ", version " << score.at("version") << ": "
            << (score.at("points").is_null() ? "no points, as the session says none of its metrics"
                                             : score.at("points").dump() + " of 100 points")
            << '\n';
  for (const auto& c : score.at("criteria"))
    std::cout << "    " << c.at("metric").get<std::string>() << "  " << c.at("value") << "  "
              << (c.at("points").is_null() ? "not said" : c.at("points").dump() + " points") << '\n';
}

void score_sessions(const Options& options, const GlobalOptions& global) {
  std::optional<score::Rubric> rubric;
  if (!options.rubric.empty()) rubric = score::load_rubric(options.rubric);
  const std::filesystem::path data = data_folder(global.data);
  nlohmann::json all = nlohmann::json::array();
  for (const std::string& name : options.sessions) all.push_back(scored(name, rubric, data));
  if (global.json)
    std::cout << (all.size() == 1 ? all.front() : all).dump() << '\n';
  else
    for (const nlohmann::json& one : all) print(one);
}

}  // namespace

void add_score_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("score", "Compute the metrics of recorded sessions anew");
  command
      ->add_option("SESSION", options->sessions,
                   "Id of the data folder, a folder with recording.ream, or such a file; one or more")
      ->required();
  command->add_option("--rubric", options->rubric,
                      "Turn the metrics into points by this file (proto/rubric.schema.json)");
  command->callback([options, &global] { score_sessions(*options, global); });
}

}  // namespace ream::app
