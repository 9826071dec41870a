#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/cli/terminal_progress.hpp"
#include "app/mesh_source.hpp"
#include "app/modulus_options.hpp"
#include "app/open_database.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/log.hpp"
#include "session/export/export_formats.hpp"
#include "session/load/component_load.hpp"
#include "session/simulation/recorded_session.hpp"
#include "solve/bone_compression.hpp"

namespace ream::app {
namespace {

struct SolveOptions {
  std::string input, case_name, axis = "z", platens = "sliding";
  ModulusOptions modulus;
  std::optional<double> threshold;
  double strain_percent = 1.0;
  int upsample = 1;
  solve::CompressionRequest request;
  std::string backend = "auto";
  bool component = false;
  session::ComponentLoadRequest load;
};

/// Nothing for the processor. `auto` takes a graphics processor alone: on the processor OpenCL takes longer.
std::optional<gpu::Queue> queue_for(const std::string& backend) {
  if (backend == "cpu") return std::nullopt;
  if (backend == "auto") {
    for (const gpu::Device& device : gpu::list_devices())
      if (!device.is_cpu && device.knows_doubles && device.keeps_small_floats)
        return std::make_optional<gpu::Queue>(device);
    return std::nullopt;
  }
  if (!backend.starts_with("opencl"))
    throw Error(ErrorKind::usage, "--backend '" + backend + "' is not auto, cpu, opencl or opencl:N");
  return std::make_optional<gpu::Queue>(gpu::choose_device(backend, gpu::Use::bulk));
}

std::string name_of(const std::optional<gpu::Queue>& queue) {
  return queue ? "opencl: " + queue->device().name : "cpu";
}

/// Four digits of it.
std::string text(double value) {
  char written[32];
  std::snprintf(written, sizeof written, "%.4g", value);
  return written;
}

void print(const solve::CompressionResult& r, const SolveOptions& options, const std::string& backend) {
  std::cout << "apparent modulus " << text(r.modulus_mpa) << " MPa along " << options.axis << ": "
            << text(r.force_n) << " N at " << options.strain_percent << " % of strain\n"
            << r.elements << " elements; bone fills " << text(100.0 * r.bone_share) << " % of a box of "
            << text(r.box_mm.x()) << " x " << text(r.box_mm.y()) << " x " << text(r.box_mm.z())
            << " mm; Voigt's bound " << text(r.voigt_mpa) << " MPa";
  if (r.reuss_mpa > 0.0) std::cout << ", Reuss' bound " << text(r.reuss_mpa) << " MPa";
  std::cout << "\neffective strain: median " << text(r.effective_strain[0]) << ", 95 % below "
            << text(r.effective_strain[1]) << ", 99 % below " << text(r.effective_strain[2]) << ", greatest "
            << text(r.effective_strain[3]) << '\n';
  if (r.components.removed_voxels > 0)
    std::cout << r.components.components - 1 << " islands of " << r.components.removed_voxels
              << " voxels were removed\n";
  if (r.unloaded_elements > 0)
    std::cout << r.unloaded_elements << " voxels do not reach both platens and carry nothing\n";
  std::cout << r.iterations << " iterations in " << text(r.solve_s) << " s on " << backend
            << "; forces out of balance: " << text(r.unbalanced) << " of the platens'\n";
}

std::string strain_text(const std::optional<double>& strain) { return strain ? text(100.0 * *strain) : "-"; }

void print(const session::ComponentLoad& load) {
  std::cout << "component under " << text(load.request.force_n) << " N, cells of " << load.request.cell_mm
            << " mm; strains in percent, motions in um\n";
  std::printf("%-8s %-10s %9s %9s %9s %12s %12s %12s\n", "state", "load", "carrying", "motion", "sinking",
              "plate strain", "bone strain", "overstrained");
  for (const session::LoadedState& state : load.states) {
    for (const session::LoadedSeat& seat : state.loads)
      std::printf("%-8s %-10s %7.1f %% %9.1f %9.1f %12s %12s %10.1f %%%s\n", state.name.c_str(),
                  seat.name.c_str(), seat.carrying_percent, seat.motion_um, seat.sinking_um,
                  strain_text(seat.plate_strain).c_str(), strain_text(seat.bone_strain).c_str(),
                  seat.overstrained_percent, seat.settled ? "" : "  not settled");
    std::printf("%-8s supported %.1f %%; a load lifts off up to %.1f %% of that\n", state.name.c_str(),
                state.supported_percent, state.support_lost_percent);
  }
}

void load_seated_component(const SolveOptions& options, const GlobalOptions& global) {
  catch_interrupts();
  const TerminalProgress progress;
  session::ExportRequest source;
  source.data = data_folder(global.data);
  source.recording = session::recording_path(options.input, source.data);
  source.case_name = options.case_name;
  note_reading(global.db, source.data, "data.mesh", {options.input, options.case_name});
  session::ComponentLoadRequest request = options.load;
  fe::ElementModel densities;
  densities.gray_is_density_g_cc = true;
  request.law = options.modulus.law_for(densities);
  request.materials.poisson = options.request.rule.poisson;
  request.threads = options.request.threads;
  request.limits.max_iterations = options.request.limits.max_iterations;
  const std::optional<gpu::Queue> queue = queue_for(options.backend);
  request.limits.queue = queue ? &*queue : nullptr;
  const session::ComponentLoad load = session::load_recorded(session::recording_of(source), source.case_name,
                                                             source.data, request, std::cref(progress))
                                          .load;
  if (!load.settled())
    log::warn("not every load has settled, so these figures are rough; try another --cell-mm");
  if (global.json)
    std::cout << to_json(load).dump() << '\n';
  else
    print(load);
}

void solve_bone(const SolveOptions& options, const GlobalOptions& global) {
  if (options.component) return load_seated_component(options, global);
  catch_interrupts();
  MemoryBudget budget;
  solve::CompressionRequest request = options.request;
  const std::optional<gpu::Queue> queue = queue_for(options.backend);
  request.limits.queue = queue ? &*queue : nullptr;
  request.compression = {options.axis[0] - 'x', options.strain_percent / 100.0, options.platens == "fixed"};
  const TerminalProgress progress;
  const std::filesystem::path data = data_folder(global.data);
  note_reading(global.db, data, "data.mesh", {options.input, options.case_name});
  fe::ElementModel model = open_mesh_source({options.input, options.case_name, options.threshold, data},
                                            budget, part_of(std::cref(progress), 0.0, 0.2));
  request.rule.law = options.modulus.law_for(model);
  for (const std::string& remark : model.remarks) log::warn(remark);
  const solve::CompressionResult result =
      solve::compress(fe::refined(std::move(model), options.upsample, budget), request, budget,
                      part_of(std::cref(progress), 0.2, 1.0));
  if (!result.converged)
    throw Error(ErrorKind::unavailable, "not converged after " + std::to_string(result.iterations) +
                                            " iterations: the residual is " + text(result.relative_residual) +
                                            " of the first; give a larger --max-iterations or --tolerance");
  if (global.json) {
    nlohmann::json answer = to_json(result);
    answer["backend"] = name_of(queue);
    std::cout << answer.dump() << '\n';
  } else {
    print(result, options, name_of(queue));
  }
}

}  // namespace

void add_solve_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<SolveOptions>();
  CLI::App* command = app.add_subcommand(
      "solve",
      "Compress bone between two platens, or load a component on a reamed glenoid, by finite elements");
  command
      ->add_option(
          "INPUT", options->input,
          "Volume (DICOM folder, .nrrd, .nii, .mha, zip), text rows x y z gray, case, or session: the "
          "bone that it left")
      ->required();
  command->add_option("--axis", options->axis, "Along which it is compressed")
      ->check(CLI::IsMember({"x", "y", "z"}))
      ->capture_default_str();
  command->add_option("--strain-percent", options->strain_percent, "Of the height")->capture_default_str();
  command->add_option("--platens", options->platens, "sliding or fixed")
      ->check(CLI::IsMember({"sliding", "fixed"}))
      ->capture_default_str();
  options->modulus.add_to(*command);
  command->add_option("--poisson", options->request.rule.poisson, "Poisson's ratio")->capture_default_str();
  command->add_option("--threshold", options->threshold,
                      "Least gray value (cases and sessions: density, g/cc) that is bone. Default: volumes "
                      "above 0, else all");
  command->add_option("--upsample", options->upsample, "Parts of a voxel per axis")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  command->add_flag("--keep-islands", options->request.keep_islands,
                    "Keep what does not hang together with the largest part");
  command->add_option("--tolerance", options->request.limits.tolerance, "Of the residual, over the first one")
      ->check(CLI::Range(1e-8, 0.1))
      ->capture_default_str();
  command->add_option("--max-iterations", options->request.limits.max_iterations, "At most so many")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--threads", options->request.threads, "The result is the same with any number")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_option("--backend", options->backend, "auto, cpu, opencl or opencl:N; the result is the same")
      ->capture_default_str();
  command->add_option("--case", options->case_name,
                      "Case folder of a session, where it is not in the data folder");
  command->add_flag("--component", options->component,
                    "Of a session: load a component on the glenoid instead, before and after reaming");
  CLI::Option* component = command->get_option("--component");
  for (const char* other : {"--axis", "--strain-percent", "--platens", "--threshold", "--upsample",
                            "--keep-islands", "--tolerance"})
    component->excludes(command->get_option(other));
  command->add_option("--force-n", options->load.force_n, "On the component")
      ->needs(component)
      ->check(CLI::Range(1.0, 10000.0))
      ->capture_default_str();
  command->add_option("--cell-mm", options->load.cell_mm, "Elements under the component")
      ->needs(component)
      ->check(CLI::Range(0.3, 2.0))
      ->capture_default_str();
  command->callback([options, &global] { solve_bone(*options, global); });
}

}  // namespace ream::app
