#include <CLI/CLI.hpp>
#include <functional>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/cli/terminal_progress.hpp"
#include "app/open_database.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/leftovers.hpp"
#include "score/rubric_store.hpp"
#include "session/export/export_formats.hpp"
#include "session/simulation/recorded_session.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  std::string session, case_name, format, rubric, benchmark;
  bool component_load = false;
  fs::path out;
};

session::ExportRequest request_of(const ExportOptions& options, const fs::path& data) {
  session::ExportRequest request;
  request.recording = session::recording_path(options.session, data);
  request.case_name = options.case_name;
  request.data = data;
  if (!options.rubric.empty())
    request.rubric = score::find_rubric(options.rubric, score::RubricStore(rubrics_folder(data)));
  request.component_load = options.component_load;
  if (!options.benchmark.empty()) request.benchmark = score::load_benchmark(options.benchmark);
  return request;
}

void export_session(const ExportOptions& options, const GlobalOptions& global) {
  const session::ExportFormat& format = session::export_format_of(options.format, options.out);
  if (format.kind != session::ExportKind::report &&
      (options.component_load || !(options.rubric.empty() && options.benchmark.empty())))
    throw Error(ErrorKind::usage, "--rubric, --benchmark and --component-load are for reports, and " +
                                      options.out.string() + " will be none");
  catch_interrupts();
  remove_leftovers_beside(options.out);
  const fs::path data = data_folder(global.data);
  note_reading(global.db, data, "session.export", {options.session, options.case_name});
  const TerminalProgress progress;
  format.write(request_of(options, data), options.out, std::cref(progress));
  if (global.json)
    std::cout << nlohmann::json{{"out", options.out.string()}}.dump() << '\n';
  else
    std::cout << options.out.string() << '\n';
}

std::string words_of_formats() {
  std::string words;
  for (const session::ExportFormat& format : session::export_formats())
    if (&session::export_format_of({}, "a" + format.extension) == &format)
      words += (words.empty() ? "FILE" : "; FILE") + format.extension + ": " + format.words;
  return words;
}

std::string names_of_formats() {
  std::string words;
  for (const session::ExportFormat& format : session::export_formats())
    words += (words.empty() ? "" : ", ") + format.name;
  return words;
}

}  // namespace

void add_export_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command = app.add_subcommand("export", "Write a recorded session as a file for other programs");
  command
      ->add_option("SESSION", options->session,
                   "Id of the data folder, a folder with recording.ream, or such a file")
      ->required();
  command->add_option("--out", options->out, words_of_formats())->required();
  command->add_option("--format", options->format,
                      "What it becomes whatever its ending: " + names_of_formats());
  command->add_option("--case", options->case_name,
                      "Case folder, where the recording's case is not in the data folder");
  command->add_option("--rubric", options->rubric, "Of reports: a rubric's id, id@version, or its file");
  command->add_option("--benchmark", options->benchmark,
                      "Of reports: file of ream benchmark to compare with");
  command->add_flag("--component-load", options->component_load,
                    "Of reports: with a page of a component under load, which takes half a minute");
  command->callback([options, &global] { export_session(*options, global); });
}

}  // namespace ream::app
