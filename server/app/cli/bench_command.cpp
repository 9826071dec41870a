#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <memory>

#include "app/cli/commands.hpp"
#include "core/error.hpp"

namespace ream::app {
namespace {

struct BenchOptions {
  std::string suite, plots;
  bool baselines = false, check = false;
};

/// ream-bench is built from tests/bench, beside this program, and is not packaged.
std::filesystem::path bench_program() {
  std::error_code failed;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", failed);
  const auto program = self.parent_path() / "ream-bench";
  if (failed || !std::filesystem::exists(program))
    throw Error(ErrorKind::not_found,
                "no ream-bench beside ream; build the project with REAM_TESTS=ON to measure it");
  return program;
}

void bench(const BenchOptions& options, const GlobalOptions& global) {
  std::vector<std::string> words{bench_program().string()};
  if (!options.suite.empty()) words.push_back(options.suite);
  if (!options.plots.empty()) words.insert(words.end(), {"--plots", options.plots});
  if (options.baselines) words.push_back("--baselines");
  if (options.check) words.push_back("--check");
  if (global.json) words.push_back("--json");
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv(arguments[0], arguments.data());
  throw Error(ErrorKind::io, "cannot run " + words[0] + ": " + std::strerror(errno));
}

}  // namespace

void add_bench_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command = app.add_subcommand("bench", "Measure this build (runs ream-bench)");
  command->add_option("suite", options->suite, "One suite; all when left out");
  command->add_flag("--baselines", options->baselines, "Measure the baselines too");
  command->add_option("--plots", options->plots,
                      "Folder for the pictures of the suite validate. Default: ./ream-validate");
  command->add_flag("--check", options->check, "Exit 1 and name the rows that miss their goal");
  command->callback([options, &global] { bench(*options, global); });
}

}  // namespace ream::app
