#include <CLI/CLI.hpp>
#include <functional>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/cli/terminal_progress.hpp"
#include "app/numbers.hpp"
#include "app/plugin_option.hpp"
#include "core/atomic_file.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/interrupt.hpp"
#include "force/feed_model.hpp"
#include "session/live/headless_run.hpp"
#include "session/scoring/score_document.hpp"
#include "session/simulation/reamed_pictures.hpp"
#include "session/simulation/session_setup.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

struct SimulateOptions {
  session::RunRequest request;
  std::string tool_axis;
  std::string removal = "profile";
  double force_scale = 0.0;
  fs::path out;
  bool wall_clock = false;
  std::vector<fs::path> plugins;
};

std::string feed_models_help() {
  std::string text = "Feed model: ";
  for (const force::FeedModelEntry& model : force::feed_models())
    text += std::string(model.name) + " (" + model.description + "), ";
  return text + "default: the script's";
}

std::vector<std::string> feed_model_names() {
  std::vector<std::string> names;
  for (const force::FeedModelEntry& model : force::feed_models()) names.emplace_back(model.name);
  return names;
}

/// ./ream-out/<n> with the first n that is free.
fs::path next_output_folder() {
  for (int n = 1;; ++n) {
    const fs::path folder = fs::path("ream-out") / std::to_string(n);
    std::error_code failed;
    if (!fs::exists(folder, failed)) return folder;
  }
}

void simulate(const SimulateOptions& options, const GlobalOptions& global) {
  session::RunRequest request = options.request;
  if (options.removal == "decay") request.removal = sim::RemovalLaw::decay;
  if (!options.tool_axis.empty()) {
    const auto v = parse_numbers(options.tool_axis, 6, "--tool-axis");
    request.tool_axis = shell::ToolAxis{Vec3(v[0], v[1], v[2]), Vec3(v[3], v[4], v[5])};
  }
  if (options.force_scale > 0.0) request.force_scale = options.force_scale;

  const fs::path out = options.out.empty() ? next_output_folder() : options.out;
  AtomicFolder folder(out);
  catch_interrupts();
  session::Simulation simulation(session::build_setup(request, data_folder(global.data)));
  const std::vector<uint8_t> before = simulation.bone_case.bone.coverage;
  const session::SessionFiles::Results result = [&] {
    const TerminalProgress progress;
    return session::run_headless(simulation, before, folder.path(), options.wall_clock, std::cref(progress));
  }();
  session::keep_score(folder.path(), data_folder(global.data));
  throw_if_interrupted();
  folder.commit();
  // A picture that cannot be drawn costs no session.
  try {
    session::write_reamed_pictures(simulation, before, out);
  } catch (const Error& failure) {
    throw Error(failure.kind(),
                std::string(failure.what()) + "; the session itself is kept in " + out.string());
  }

  if (global.json) {
    nlohmann::json summary = result.metrics;
    summary["out"] = out.string();
    std::cout << summary.dump() << '\n';
    return;
  }
  const auto number = [&](const char* key) { return result.metrics.at(key).get<double>(); };
  std::cout << "removed " << number("removed_volume_mm3") << " mm3";
  if (result.metrics.at("reaming_depth_mm").is_number())
    std::cout << ", " << number("reaming_depth_mm") << " mm deep";
  if (result.metrics.at("axial_thrust_mean_n").is_number())
    std::cout << ", thrust " << number("axial_thrust_mean_n") << " N mean and "
              << number("axial_thrust_peak_n") << " N peak";
  std::cout << "\ntick mean " << result.timing.at("tick_us").at("mean").get<double>() << " us on "
            << simulation.state.backend.name
            << (simulation.state.backend.choice.empty() ? "" : " (" + simulation.state.backend.choice + ")")
            << '\n'
            << out.string() << '\n';
}

}  // namespace

void add_simulate_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* command =
      app.add_subcommand("simulate", "Run a scripted reaming without a screen and write what happened");
  command
      ->add_option("--case", options->request.case_name,
                   "Case: demo, an id of the data folder, or a case folder")
      ->required();
  command
      ->add_option("--script", options->request.script_name,
                   "Script: demo or a JSON file (proto/script.schema.json)")
      ->required();
  command->add_option("--out", options->out,
                      "Folder for the results; must be new or empty. Default: ./ream-out/<n>");
  command->add_flag("--realtime", options->wall_clock,
                    "One tick a millisecond instead of as fast as it goes");
  command->add_option("--backend", options->request.backend, "auto, cpu, opencl or opencl:N")
      ->capture_default_str();
  command->add_option("--model", options->request.feed_model, feed_models_help())
      ->check(CLI::IsMember(feed_model_names()));
  command
      ->add_option(
          "--removal", options->removal,
          "Removal law: profile (distance to the swept cutting body) or decay (the thesis' algorithm "
          "4.1, for comparison)")
      ->check(CLI::IsMember({"profile", "decay"}))
      ->capture_default_str();
  command->add_option("--tool", options->request.tool,
                      "Reamer: 'sphere R', 'ellipse A,B' or a mesh file. Default: the plan's");
  command->add_option(
      "--tool-axis", options->tool_axis,
      "X,Y,Z,DX,DY,DZ: a point of a mesh tool's axis and its feed direction, in the file's mm");
  command
      ->add_option("--tool-spacing-mm", options->request.tool_spacing_mm,
                   "Distance of the points that feel bone")
      ->check(CLI::Range(0.02, 5.0))
      ->capture_default_str();
  command
      ->add_option("--force-scale", options->force_scale,
                   "Simulated newtons per hand newton, instead of the script's")
      ->check(CLI::Range(0.01, 1000.0));
  command->add_option("--random-seed", options->request.random_seed, "Seed of everything random")
      ->capture_default_str();
  add_plugin_option(*command, options->plugins);
  command->callback([options, &global] {
    use_plugins(options->plugins);
    if (const auto plugin = force::offered_feed_model(); plugin && !options->request.feed_model.empty())
      throw Error(ErrorKind::usage, "--model " + options->request.feed_model + " and " + plugin->in_words() +
                                        " both give a feed model; give one of them");
    simulate(*options, global);
  });
}

}  // namespace ream::app
