#include "app/plugin_option.hpp"

#include <CLI/CLI.hpp>

namespace ream::app {

void add_plugin_option(CLI::App& command, std::vector<std::filesystem::path>& files) {
  command
      .add_option("--plugin", files,
                  "Shared object with a feed model, score or device of your own (`ream plugin` tries it); "
                  "several may be given")
      ->allow_extra_args(false);
}

std::vector<plugin::Plugin> use_plugins(const std::vector<std::filesystem::path>& files) {
  std::vector<plugin::Plugin> loaded;
  for (const std::filesystem::path& file : files) {
    loaded.push_back(plugin::load_plugin(file));
    plugin::offer(loaded.back());
  }
  return loaded;
}

}  // namespace ream::app
