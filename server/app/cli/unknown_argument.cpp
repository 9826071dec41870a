#include "app/cli/commands.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>

namespace ream::app {
namespace {

/// Letters to put in, take out, change, or swap with their neighbour, to get from one to the other (optimal
/// string alignment).
size_t edits(const std::string& a, const std::string& b) {
  std::vector<std::vector<size_t>> count(a.size() + 1, std::vector<size_t>(b.size() + 1));
  for (size_t i = 0; i <= a.size(); ++i) {
    for (size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        count[i][j] = i + j;
        continue;
      }
      const size_t changed = count[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      count[i][j] = std::min({changed, count[i - 1][j] + 1, count[i][j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        count[i][j] = std::min(count[i][j], count[i - 2][j - 2] + 1);
    }
  }
  return count[a.size()][b.size()];
}

/// "; did you mean ...?", or nothing where none of them is near.
std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return edits(word, a) < edits(word, b);
  });
  if (nearest == known.end() || edits(word, *nearest) > std::max<size_t>(1, word.size() / 3)) return {};
  return "; did you mean '" + *nearest + "'?";
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_below(app)) names.push_back(command->get_name());
  return names;
}

const CLI::Option* find_option(const CLI::App* command, const std::string& name) {
  for (; command != nullptr; command = command->get_parent())
    if (const CLI::Option* option = command->get_option_no_throw(name)) return option;
  return nullptr;
}

/// "-5" is a number, not an option.
bool is_option(const std::string& argument) {
  return argument.size() > 1 && argument[0] == '-' && argument != "--" &&
         std::isdigit(static_cast<unsigned char>(argument[1])) == 0 && argument[1] != '.';
}

std::string full_name(const CLI::App* command) {
  return command->get_parent() == nullptr ? "ream"
                                          : full_name(command->get_parent()) + " " + command->get_name();
}

}  // namespace

std::vector<const CLI::App*> commands_below(const CLI::App& command) {
  return command.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* above = &command; above != nullptr; above = above->get_parent())
    for (const CLI::Option* option : above->get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string unknown_argument(const CLI::App& app, const std::vector<std::string>& arguments) {
  const CLI::App* command = &app;
  for (size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (argument == "--") return {};
    if (is_option(argument)) {
      const std::string name = argument.substr(0, argument.find('='));
      const CLI::Option* option = find_option(command, name);
      if (option == nullptr)
        return "no option '" + name + "' of " + full_name(command) + suggestion(name, option_names(*command));
      const bool has_value = name.size() < argument.size() || option->get_expected_max() == 0;
      if (!has_value) i += static_cast<size_t>(option->get_type_size());
    } else if (const std::vector<std::string> names = command_names(*command); !names.empty()) {
      if (std::find(names.begin(), names.end(), argument) == names.end())
        return "no command '" + full_name(command) + " " + argument + "'" + suggestion(argument, names);
      command = command->get_subcommand(argument);
    }
  }
  return {};
}

}  // namespace ream::app
