#include "app/cli/commands.hpp"

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <set>
#include <toml.hpp>

#include "core/error.hpp"

namespace ream::app {
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : value;
}

std::string in_words(const std::set<std::string>& names) {
  std::string words;
  for (const std::string& name : names) words += (words.empty() ? "" : ", ") + name;
  return words;
}

/// Reads TOML for CLI11, whose own reader takes a misspelt line for a value.
class TomlSettings : public CLI::Config {
 public:
  explicit TomlSettings(const CLI::App& app) : app_(app) {}

  /// Only read here.
  std::string to_config(const CLI::App* /*app*/, bool /*defaults*/, bool /*described*/,
                        std::string /*prefix*/) const override {
    return {};
  }

  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override {
    file_ = app_.get_config_ptr()->as<std::string>();
    std::vector<CLI::ConfigItem> found;
    for (const auto& [name, value] : parsed(input)) {
      if (value.is_table())
        add_section(name, value, found);
      else if (!overruled(name))
        found.push_back(item({}, name, value, app_, global_names));
    }
    return found;
  }

 private:
  static inline const std::set<std::string> global_names{"data", "db"};

  /// The environment comes before the file.
  static bool overruled(const std::string& name) {
    return (name == "data" && !environment("REAM_DATA").empty()) ||
           (name == "db" && !environment("REAM_DB").empty());
  }

  toml::table parsed(std::istream& input) const try {
    return toml::parse(input, file_).as_table();
  } catch (const toml::exception& e) {
    throw Error(ErrorKind::usage,
                place(e.location()) + "not TOML; see https://toml.io, and write texts in quotes");
  }

  void add_section(const std::string& name, const toml::value& section,
                   std::vector<CLI::ConfigItem>& found) const {
    if (name != "serve")
      throw Error(ErrorKind::usage,
                  place(section.location()) + "no section [" + name + "]; there is [serve]");
    const CLI::App& command = *app_.get_subcommand(name);
    const std::set<std::string> names = option_names(command);
    for (const auto& [key, value] : section.as_table())
      if (CLI::ConfigItem read = item({name}, key, value, command, names); !read.inputs.empty())
        found.push_back(std::move(read));
  }

  static std::set<std::string> option_names(const CLI::App& command) {
    std::set<std::string> names;
    for (const CLI::Option* option : command.get_options())
      if (option->get_configurable() && option != command.get_help_ptr())
        names.insert(option->get_single_name());
    return names;
  }

  CLI::ConfigItem item(std::vector<std::string> parents, const std::string& key, const toml::value& value,
                       const CLI::App& command, const std::set<std::string>& known) const {
    if (!known.contains(key))
      throw Error(ErrorKind::usage, place(value.location()) + "no setting '" + key + "'" +
                                        (parents.empty() ? "" : " in [" + parents.front() + "]") +
                                        "; there are " + in_words(known));
    CLI::ConfigItem made;
    made.parents = std::move(parents);
    made.name = key;
    const bool several = command.get_option("--" + key)->get_expected_max() > 1;
    if (value.is_array() && several) {
      for (const toml::value& entry : value.as_array()) made.inputs.push_back(text(key, entry));
    } else {
      made.inputs.push_back(text(key, value));
    }
    return made;
  }

  std::string text(const std::string& key, const toml::value& value) const {
    if (value.is_string()) return value.as_string().str;
    if (value.is_integer()) return std::to_string(value.as_integer());
    if (value.is_boolean()) return value.as_boolean() ? "true" : "false";
    throw Error(ErrorKind::usage,
                place(value.location()) + "'" + key + "' is a text, a whole number, true or false");
  }

  std::string place(const toml::source_location& location) const {
    return file_ + ", line " + std::to_string(location.line()) + ": ";
  }

  const CLI::App& app_;
  mutable std::string file_;
};

}  // namespace

void add_settings_file(CLI::App& app) {
  const std::string file = environment("REAM_CONFIG");
  app.set_config("--config", file, "Settings, a TOML file. Default: REAM_CONFIG, else none", !file.empty());
  app.get_config_ptr()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.config_formatter(std::make_shared<TomlSettings>(app));
}

}  // namespace ream::app
