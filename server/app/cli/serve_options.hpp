#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/server_address.hpp"

namespace CLI {
class App;
}

namespace ream::app {

/// Options of `ream serve`, from the command line or from a settings file.
struct ServeOptions {
  ServerAddress address;
  std::string openigtlink;  ///< as on the command line; empty: not wanted
  std::filesystem::path web;
  std::string backend = "auto", realtime = "try", device = "script", log_format = "auto";
  std::optional<int> keep_sessions_days;
  int keep_deleted_days = 30, end_unstarted_minutes = 10, end_paused_minutes = 30;
  int delete_at_once_percent = 50;
  std::vector<std::filesystem::path> plugins;
};

/// Adds them to the command; `options` must outlive it.
void add_serve_options(CLI::App& command, ServeOptions& options);

}  // namespace ream::app
