#pragma once
#include <filesystem>
#include <vector>

#include "plugin/plugin.hpp"

namespace CLI {
class App;
}

namespace ream::app {

/// --plugin FILE, as often as there are plug-ins; `files` must outlive the command.
void add_plugin_option(CLI::App& command, std::vector<std::filesystem::path>& files);

/// Tries, loads and offers each. Errors: those of plugin::load_plugin and offer.
std::vector<plugin::Plugin> use_plugins(const std::vector<std::filesystem::path>& files);

}  // namespace ream::app
