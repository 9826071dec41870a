#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/data_folder.hpp"
#include "app/export_session.hpp"
#include "app/recorded_session.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string session, case_name, rubric = "standard", benchmark;
  fs::path out;
};

void export_session(const Options& options, const GlobalOptions& global) {
  const ExportFormat& format = export_format_of(options.out);
  const fs::path data = data_folder(global.data);
  format.write(
      {recording_path(options.session, data), options.case_name, data, options.rubric, options.benchmark},
      options.out, no_progress);
  if (global.json)
    std::cout << nlohmann::json{{"out", options.out.string()}}.dump() << '\n';
  else
    std::cout << options.out.string() << '\n';
}

std::string words_of_formats() {
  std::string words;
  for (const ExportFormat& format : export_formats())
    words += (words.empty() ? "FILE" : "; FILE") + format.extension + ": " + format.words;
  return words;
}

}  // namespace

void add_export_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("export", "Write a recorded session as a file for other programs");
  command
      ->add_option("SESSION", options->session,
                   "Id of the data folder, a folder with recording.ream, or such a file")
      ->required();
  command->add_option("--out", options->out, words_of_formats())->required();
  command->add_option("--case", options->case_name,
                      "Case folder, where the recording's case is not in the data folder");
  command->add_option("--rubric", options->rubric, "Of reports: a rubric's id, id@version, or its file");
  command->add_option("--benchmark", options->benchmark,
                      "Of reports: file of ream benchmark to compare with");
  command->callback([options, &global] { export_session(*options, global); });
}

}  // namespace ream::app
