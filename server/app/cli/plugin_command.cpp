#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "plugin/plugin.hpp"

namespace ream::app {
namespace {

void try_plugin(const std::filesystem::path& file, const GlobalOptions& global) {
  const plugin::Plugin plugin = plugin::load_plugin(file);
  if (!global.json) {
    std::cout << plugin::in_words(plugin) << '\n';
    return;
  }
  nlohmann::json answer = plugin.trial;
  answer["sha256"] = plugin.identity.sha256;
  std::cout << answer.dump() << '\n';
}

}  // namespace

void add_plugin_command(CLI::App& app, GlobalOptions& global) {
  auto file = std::make_shared<std::filesystem::path>();
  CLI::App* command = app.add_subcommand(
      "plugin", "Try a plug-in as `--plugin` does: its speed, and what it may not do in a tick");
  command->add_option("file", *file, "Shared object (docs/plugins.md)")->required();
  command->callback([file, &global] { try_plugin(*file, global); });
}

}  // namespace ream::app
