#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/plugin_identity.hpp"
#include "plugin/ream_plugin.h"

namespace ream::plugin {

/// What a feed model may take of the processor in 99 of 100 ticks: a twentieth of a tick.
inline constexpr double feed_budget_us = 50.0;
inline constexpr int trial_ticks = 20'000;

/// A shared object of the user's own that has been tried, and is loaded to the end of the process.
// NOLINTNEXTLINE(bugprone-exception-escape): to move JSON throws nothing.
struct Plugin {
  PluginIdentity identity;
  const ream_plugin_description* description = nullptr;
  /// What the trial found: "feed", where there is one, with "ticks", "p50_us", "p99_us" and "max_us" of
  /// processor time; "score", true or false; "device", its name.
  nlohmann::json trial;
};

/// Looks at the file, tries it in a process of its own (ream-plugin-trial), and loads it. Errors, each one
/// line: not_found; invalid_input for what is no regular file of the user's or root's that only its owner may
/// write or replace, and for a plug-in that the trial refuses; io when the trial cannot be started.
Plugin load_plugin(const std::filesystem::path& file);

/// One line for people: who it is, what it has, and what its feed model takes.
std::string in_words(const Plugin& plugin);

/// New sessions of this process have its feed model, its score is beside the rubric's, and its device can be
/// chosen. To be called before there are sessions. Error conflict when something else has its place.
void offer(const Plugin& plugin);

}  // namespace ream::plugin
