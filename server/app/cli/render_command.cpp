#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/cli/terminal_progress.hpp"
#include "app/open_database.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "session/export/export_formats.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/reamed_pictures.hpp"
#include "session/simulation/recorded_session.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

struct RenderOptions {
  std::string what;
  fs::path out;
};

bool is_case(const std::string& name, const fs::path& data) {
  return name == "demo" || fs::exists(session::case_folder_of(name, data) / "case.json");
}

void render_case(const std::string& name, const fs::path& data, const fs::path& out) {
  const case_::Case shown = session::find_case(name, data);
  session::write_picture(shown, shown.bone.coverage, out, session::case_surroundings(name, data));
}

void render_session(const std::string& session, const fs::path& data, const fs::path& out) {
  session::ExportRequest request;
  request.recording = session::recording_path(session, data);
  request.data = data;
  const TerminalProgress progress;
  session::export_format_of("png", out).write(request, out, std::cref(progress));
}

void render(const RenderOptions& options, const GlobalOptions& global) {
  if (options.out.extension() != ".png")
    throw Error(ErrorKind::usage, options.out.string() + ": pictures are written as .png");
  catch_interrupts();
  const fs::path data = data_folder(global.data);
  note_reading(global.db, data, is_case(options.what, data) ? "case.read" : "session.export", {options.what});
  if (is_case(options.what, data))
    render_case(options.what, data, options.out);
  else
    render_session(options.what, data, options.out);
  if (global.json)
    std::cout << nlohmann::json{{"out", options.out.string()}}.dump() << '\n';
  else
    std::cout << options.out.string() << '\n';
}

}  // namespace

void add_render_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command =
      app.add_subcommand("render", "Draw a case, or the bone that a session left, without a screen");
  command
      ->add_option("WHAT", options->what,
                   "demo, a case's id or folder; or a session's id, folder or recording.ream")
      ->required();
  command->add_option("--out", options->out, "FILE.png")->required();
  command->callback([options, &global] { render(*options, global); });
}

}  // namespace ream::app
