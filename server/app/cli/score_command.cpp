#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/cli/terminal_progress.hpp"
#include "app/data_folder.hpp"
#include "app/interrupt.hpp"
#include "app/rescoring.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "score/rubric.hpp"

namespace ream::app {
namespace {

struct Options {
  std::vector<std::string> sessions;
  bool all = false;
  std::string rubric, case_name;
};

nlohmann::json to_json(const Rescored& one, const std::optional<score::Rubric>& rubric) {
  if (!one.error.empty()) return {{"session", one.name}, {"error", one.error}};
  nlohmann::json json = {{"session", one.name}, {"metrics", one.metrics}};
  if (rubric) json["score"] = score::to_json(*rubric, score::apply_rubric(*rubric, json["metrics"]));
  return json;
}

void print_metrics(const nlohmann::json& metrics) {
  const nlohmann::json& unsaid = metrics.at("unsaid");
  for (const auto& [key, value] : metrics.items()) {
    if (key == "unsaid") continue;
    std::cout << "  " << key << "  ";
    if (value.is_null() && unsaid.contains(key))
      std::cout << "not said: " << unsaid.at(key).get<std::string>() << '\n';
    else
      std::cout << value << '\n';
  }
}

void print(const nlohmann::json& json) {
  std::cout << json.at("session").get<std::string>() << '\n';
  const bool by_rubric = json.contains("score");
  if (json.contains("error")) return;
  if (!by_rubric) return print_metrics(json.at("metrics"));
  const nlohmann::json& score = json.at("score");
  std::cout << "  " << score.at("rubric").get<std::string>() << ", version " << score.at("version") << ": "
            << (score.at("points").is_null() ? "no points, as the session says none of its metrics"
                                             : score.at("points").dump() + " of 100 points")
            << '\n';
  for (const auto& c : score.at("criteria"))
    std::cout << "    " << c.at("metric").get<std::string>() << "  " << c.at("value") << "  "
              << (c.at("points").is_null() ? "not said" : c.at("points").dump() + " points") << '\n';
}

std::vector<std::string> names_of(const Options& options, const std::filesystem::path& data) {
  if (!options.all) return options.sessions;
  if (!options.sessions.empty()) throw Error(ErrorKind::usage, "name sessions, or say --all, not both");
  return recorded_sessions(data);
}

void score_sessions(const Options& options, const GlobalOptions& global) {
  std::optional<score::Rubric> rubric;
  if (!options.rubric.empty()) rubric = score::load_rubric(options.rubric);
  const std::filesystem::path data = data_folder(global.data);
  const std::vector<std::string> names = names_of(options, data);
  if (names.empty() && !options.all) throw Error(ErrorKind::usage, "name at least one session, or say --all");
  catch_interrupts();
  const std::vector<Rescored> scored = [&] {
    const TerminalProgress progress;
    return rescore(names, options.case_name, data, std::cref(progress));
  }();
  nlohmann::json all = nlohmann::json::array();
  size_t failed = 0;
  for (const Rescored& one : scored) {
    all.push_back(to_json(one, rubric));
    failed += !one.error.empty();
    if (scored.size() == 1 && failed == 1) throw Error(one.kind, one.error);
    if (!one.error.empty()) log::error(one.name + ": " + one.error);
  }
  if (global.json)
    std::cout << (all.size() == 1 && !options.all ? all.front() : all).dump() << '\n';
  else
    for (const nlohmann::json& one : all) print(one);
  if (failed > 0)
    throw Error(ErrorKind::invalid_input, std::to_string(failed) + " of " + std::to_string(scored.size()) +
                                              " sessions could not be scored; the lines above say why");
}

}  // namespace

void add_score_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("score", "Compute the metrics of recorded sessions anew");
  command->add_option("SESSION", options->sessions,
                      "Id of the data folder, a folder with recording.ream, or such a file; one or more");
  command->add_flag("--all", options->all, "All sessions of the data folder");
  command->add_option("--case", options->case_name,
                      "Where the case is, if not under the name that the recording gives");
  command->add_option("--rubric", options->rubric,
                      "Turn the metrics into points by this file (proto/rubric.schema.json)");
  command->callback([options, &global] { score_sessions(*options, global); });
}

}  // namespace ream::app
