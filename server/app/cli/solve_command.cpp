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
};

/// Four digits of it.
std::string text(double value) {
  char written[32];
  std::snprintf(written, sizeof written, "%.4g", value);
  return written;
}

void print(const solve::CompressionResult& r, const SolveOptions& options) {
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
  std::cout << r.iterations << " iterations in " << text(r.solve_s)
            << " s; forces out of balance: " << text(r.unbalanced) << " of the platens'\n";
}

void solve_bone(const SolveOptions& options, const GlobalOptions& global) {
  catch_interrupts();
  MemoryBudget budget;
  solve::CompressionRequest request = options.request;
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
  if (global.json)
    std::cout << to_json(result).dump() << '\n';
  else
    print(result, options);
}

}  // namespace

void add_solve_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<SolveOptions>();
  CLI::App* command = app.add_subcommand(
      "solve", "Compress bone between two platens, each voxel an element: apparent modulus");
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
  command->add_option("--case", options->case_name,
                      "Case folder of a session, where it is not in the data folder");
  command->callback([options, &global] { solve_bone(*options, global); });
}

}  // namespace ream::app
