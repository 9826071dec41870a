#include <CLI/CLI.hpp>
#include <iostream>
#include <string>

#include "app/cli/commands.hpp"

namespace ream::app {
namespace {

/// Words that may follow a command, as Bash has them in `compgen -W`.
std::string words(const CLI::App& command) {
  std::string all;
  for (const CLI::App* below : commands_below(command)) all += below->get_name() + " ";
  for (const std::string& name : option_names(command)) all += name + " ";
  if (!all.empty()) all.pop_back();
  return all;
}

/// A line for the command and one for each below it: what has been typed, and what may come next.
void print_cases(const CLI::App& command, const std::string& typed) {
  std::cout << "    '" << typed << "') words='" << words(command) << "' ;;\n";
  for (const CLI::App* below : commands_below(command))
    print_cases(*below, typed.empty() ? below->get_name() : typed + " " + below->get_name());
}

/// The command is found by the words that are names of commands; files complete where nothing else fits.
void print_bash(const CLI::App& app) {
  std::cout << R"bash(# Completion of ream for Bash: source <(ream completion bash)
_ream() {
  local typed='' word
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    [[ $word == -* ]] && continue
    case " $(_ream_words "$typed") " in
      *" $word "*) typed="${typed:+$typed }$word" ;;
    esac
  done
  mapfile -t COMPREPLY < <(compgen -W "$(_ream_words "$typed")" -- "${COMP_WORDS[COMP_CWORD]}")
}
_ream_words() {
  local words=''
  case "$1" in
)bash";
  print_cases(app, "");
  std::cout << R"bash(  esac
  printf '%s' "$words"
}
complete -o default -F _ream ream
)bash";
}

}  // namespace

void add_completion_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("completion", "Print a script that lets the shell complete commands");
  command->require_subcommand(1);
  command->add_subcommand("bash", "For Bash: source <(ream completion bash)")->callback([&app] {
    print_bash(app);
  });
}

}  // namespace ream::app
