#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/data_folder.hpp"
#include "app/export_session.hpp"
#include "app/recorded_session.hpp"
#include "app/session_bundle.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "geometry/mesh_export.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string session, case_name;
  fs::path out;
};

void export_session(const Options& options, const GlobalOptions& global) {
  const fs::path data = data_folder(global.data);
  const fs::path file = recording_path(options.session, data);
  const std::string kind = options.out.extension();
  if (kind != ".csv" && kind != ".png" && kind != ".zip" && !is_mesh_file_ending(kind))
    throw Error(ErrorKind::usage, "--out " + options.out.string() +
                                      " must end in .csv (force trace), .ply, .stl or .glb (reamed surface), "
                                      ".png (picture) or .zip (bundle)");
  if (kind == ".zip") {
    write_session_bundle(file, options.case_name, data, options.out);
  } else {
    const record::Recording recording(file, record::Recording::Trust::checked);
    if (const std::string& damage = recording.log().damage(); !damage.empty()) log::warn(damage);
    if (kind == ".csv") {
      export_trace(recording, options.out);
    } else {
      case_::Case bone_case = case_of(recording, options.case_name, data);
      if (kind == ".png")
        export_picture(recording, bone_case, options.out);
      else
        export_surface(recording, bone_case, options.out);
    }
  }
  if (global.json)
    std::cout << nlohmann::json{{"out", options.out.string()}}.dump() << '\n';
  else
    std::cout << options.out.string() << '\n';
}

}  // namespace

void add_export_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("export", "Write a recorded session as a file for other programs");
  command
      ->add_option("SESSION", options->session,
                   "Id of the data folder, a folder with recording.ream, or such a file")
      ->required();
  command
      ->add_option(
          "--out", options->out,
          "FILE.csv: one row a tick; FILE.ply, .stl or .glb: the reamed surface; FILE.png: a picture of "
          "it; FILE.zip: session and case, for ream import on another machine")
      ->required();
  command->add_option("--case", options->case_name,
                      "Case folder, where the recording's case is not in the data folder");
  command->callback([options, &global] { export_session(*options, global); });
}

}  // namespace ream::app
