#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/cli/terminal_progress.hpp"
#include "app/open_database.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/interrupt.hpp"
#include "report/number_text.hpp"
#include "score/benchmark.hpp"
#include "score/group_cut.hpp"
#include "score/rubric_store.hpp"
#include "session/scoring/rescoring.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct BenchmarkOptions {
  std::vector<std::string> experts, novices;
  std::string name = "experts", rubric = "standard", case_name, density = "normal";
  fs::path out;
};

std::vector<score::EndedSession> measured(const std::vector<std::string>& names,
                                          const BenchmarkOptions& options, const fs::path& data) {
  const TerminalProgress progress;
  std::vector<score::EndedSession> sessions;
  for (const session::Rescored& one : session::rescore(names, options.case_name, data, std::cref(progress))) {
    if (!one.error.empty()) throw Error(one.kind, one.name + ": " + one.error);
    sessions.push_back({one.name, nullptr, one.metrics});
  }
  return sessions;
}

void print(const score::Benchmark& benchmark, const json& cuts) {
  for (const score::BenchmarkLine& line : benchmark.lines) {
    const score::Metric* metric = score::find_metric(line.metric);
    std::cout << line.metric << "  " << (line.better == score::Better::less ? "at most " : "at least ")
              << report::with_unit(line.mean, metric ? metric->unit : "") << ", " << line.experts
              << " experts";
    if (!line.dropped.empty()) std::cout << ", " << line.dropped.size() << " left out";
    std::cout << '\n';
  }
  for (const json& cut : cuts) {
    std::cout << "cut of " << cut.at("of").get<std::string>() << "  ";
    if (cut.contains("error"))
      std::cout << cut.at("error").get<std::string>() << '\n';
    else
      std::cout << report::shortest(cut.at("cut")) << "; novices passing " << cut.at("novices_passing")
                << " of " << cut.at("novices") << ", experts failing " << cut.at("experts_failing") << " of "
                << cut.at("experts") << '\n';
  }
}

void make_benchmark(const BenchmarkOptions& options, const GlobalOptions& global) {
  const fs::path data = data_folder(global.data);
  const score::Density density = score::density_from_text(options.density);
  const score::Rubric rubric = score::find_rubric(options.rubric, score::RubricStore(rubrics_folder(data)));
  catch_interrupts();
  std::vector<std::string> all = options.experts;
  all.insert(all.end(), options.novices.begin(), options.novices.end());
  note_reading(global.db, data, "session.score.read", all);
  const auto experts = measured(options.experts, options, data);
  const score::Benchmark benchmark = score::make_benchmark(options.name, experts);
  json cuts = json::array();
  if (!options.novices.empty())
    cuts = score::group_cuts_json(measured(options.novices, options, data), experts, rubric, density);
  if (!options.out.empty()) write_json_file(options.out, score::benchmark_json(benchmark));
  if (global.json)
    std::cout << json{{"benchmark", score::benchmark_json(benchmark)}, {"cuts", cuts}}.dump() << '\n';
  else
    print(benchmark, cuts);
}

}  // namespace

void add_benchmark_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<BenchmarkOptions>();
  CLI::App* command = app.add_subcommand(
      "benchmark", "Make a benchmark of experts' sessions, and pass marks by contrasting them with novices'");
  command->add_option("EXPERT", options->experts, "Sessions of experts, as ream score takes them")
      ->required();
  command->add_option("--novices", options->novices,
                      "Sessions of novices; three or more of each give pass marks");
  command->add_option("--name", options->name, "What the benchmark is called");
  command->add_option("--out", options->out,
                      "FILE.json for ream score --benchmark (proto/benchmark.schema.json)");
  command->add_option("--rubric", options->rubric, "Whose points are contrasted, beside every metric");
  command->add_option("--density", options->density, "Of the groups: normal or kernel")
      ->check(CLI::IsMember({"normal", "kernel"}));
  command->add_option("--case", options->case_name,
                      "Where the case is, if not under the name that the recordings give");
  command->callback([options, &global] { make_benchmark(*options, global); });
}

}  // namespace ream::app
