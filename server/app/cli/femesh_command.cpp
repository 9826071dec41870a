#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/cli/terminal_progress.hpp"
#include "app/mesh_source.hpp"
#include "app/modulus_options.hpp"
#include "app/open_database.hpp"
#include "core/clock.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/log.hpp"
#include "fe/make_mesh.hpp"
#include "fe/mesh_check.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

struct FemeshOptions {
  std::string input, case_name, bin_value = "centre", axis, platens = "sliding";
  ModulusOptions modulus;
  fs::path out;
  std::optional<double> threshold, bin_width_mpa;
  double poisson = 0.3, strain_percent = 1.0;
  int upsample = 1;
  uint64_t memory_mb = 0;
  bool keep_islands = false, node_sets = false, check = false;
};

fe::MeshOptions mesh_options(const FemeshOptions& options) {
  fe::MeshOptions mesh;
  mesh.upsample = options.upsample;
  mesh.keep_islands = options.keep_islands;
  mesh.rule.poisson = options.poisson;
  mesh.rule.bin_width_mpa = options.bin_width_mpa;
  mesh.rule.bin_value = options.bin_value == "mean" ? fe::BinValue::mean : fe::BinValue::centre;
  mesh.inp.faces = options.node_sets;
  if (!options.axis.empty())
    mesh.inp.compression =
        fe::Compression{options.axis[0] - 'x', options.strain_percent / 100.0, options.platens == "fixed"};
  mesh.check = options.check;
  return mesh;
}

double peak_memory_mb() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024.0 / 1e6;
}

nlohmann::json json_of(const fe::MeshReport& r, const fe::ElementModel& about, double read_ms,
                       double time_ms) {
  return {{"elements", r.elements},
          {"nodes", r.nodes},
          {"time_ms", time_ms},
          {"peak_memory_mb", peak_memory_mb()},
          {"dims", {r.dims.x(), r.dims.y(), r.dims.z()}},
          {"spacing_mm", {r.spacing_mm.x(), r.spacing_mm.y(), r.spacing_mm.z()}},
          {"components", r.components.components},
          {"islands", r.components.components > 0 ? r.components.components - 1 : 0},
          {"island_voxels", r.components.removed_voxels},
          {"materials", r.materials.size()},
          {"modulus_min_mpa", r.materials.front().modulus_mpa},
          {"modulus_mean_mpa", r.modulus_mean_mpa},
          {"modulus_max_mpa", r.materials.back().modulus_mpa},
          {"volume_mm3", r.volume_mm3},
          {"volume_fraction", r.volume_mm3 / r.box_volume_mm3},
          {"bytes", r.bytes},
          {"phases_ms",
           {{"read", read_ms},
            {"components", r.components_ms},
            {"upsample", r.upsample_ms},
            {"materials", r.materials_ms},
            {"numbering", r.numbering_ms},
            {"write", r.write_ms},
            {"check", r.check_ms}}},
          {"warnings", about.remarks}};
}

void print(const fe::MeshReport& r, const FemeshOptions& options, double time_ms) {
  std::cout << r.elements << " elements, " << r.nodes << " nodes, " << r.materials.size() << " materials, "
            << r.volume_mm3 << " mm3 (" << 100.0 * r.volume_mm3 / r.box_volume_mm3 << " % of their box)\n"
            << "E " << r.materials.front().modulus_mpa << " to " << r.materials.back().modulus_mpa
            << " MPa, mean " << r.modulus_mean_mpa << " MPa\n";
  if (r.components.removed_voxels > 0)
    std::cout << r.components.components - 1 << " islands of " << r.components.removed_voxels
              << " voxels were removed\n";
  std::cout << options.out.string() << ": " << static_cast<double>(r.bytes) / 1e6 << " MB in "
            << time_ms / 1e3 << " s, at most " << peak_memory_mb() << " MB of memory"
            << (options.check ? ", checked" : "") << '\n';
}

/// Reads a mesh that is there already.
void check_file(const FemeshOptions& options, const MemoryBudget& budget, const GlobalOptions& global) {
  const TerminalProgress progress;
  const fe::MeshFacts facts =
      fe::check_mesh_file(options.input, fe::format_of(options.input), budget, std::cref(progress));
  if (global.json)
    std::cout << nlohmann::json{{"elements", facts.elements},
                                {"nodes", facts.nodes},
                                {"materials", facts.materials},
                                {"volume_mm3", facts.volume_mm3},
                                {"least_jacobian_mm3", facts.min_jacobian_mm3}}
                     .dump()
              << '\n';
  else
    std::cout << options.input << " is sound: " << facts.elements << " elements, " << facts.nodes
              << " nodes, " << facts.materials << " materials, " << facts.volume_mm3 << " mm3\n";
}

void femesh(const FemeshOptions& options, const GlobalOptions& global) {
  catch_interrupts();
  MemoryBudget budget;
  if (options.memory_mb > 0) {
    const fs::path folder = options.out.has_parent_path() ? options.out.parent_path() : fs::path(".");
    budget = MemoryBudget(options.memory_mb * 1'000'000, folder);
  }
  if (options.out.empty()) {
    if (!options.check) throw Error(ErrorKind::usage, "--out is required: a file that ends in .inp or .vtu");
    return check_file(options, budget, global);
  }
  fe::format_of(options.out);
  fe::MeshOptions mesh = mesh_options(options);
  const auto start = SteadyClock::now();
  const TerminalProgress progress;
  const fs::path data = data_folder(global.data);
  note_reading(global.db, data, "data.mesh", {options.input, options.case_name});
  const MeshSource source{options.input, options.case_name, options.threshold, data};
  fe::ElementModel model = open_mesh_source(source, budget, part_of(std::cref(progress), 0.0, 0.3));
  mesh.rule.law = options.modulus.law_for(model);
  fe::ElementModel about;
  about.remarks = model.remarks;
  const double read_ms = elapsed_us(start) * 1e-3;
  const fe::MeshReport report =
      fe::make_mesh(std::move(model), mesh, budget, options.out, part_of(std::cref(progress), 0.3, 1.0));
  const double time_ms = elapsed_us(start) * 1e-3;
  for (const std::string& remark : about.remarks) log::warn(remark);
  if (global.json)
    std::cout << json_of(report, about, read_ms, time_ms).dump() << '\n';
  else
    print(report, options, time_ms);
}

}  // namespace

void add_femesh_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<FemeshOptions>();
  CLI::App* command =
      app.add_subcommand("femesh", "Turn voxels into a mesh of hexahedra for finite elements");
  command
      ->add_option(
          "INPUT", options->input,
          "Volume (DICOM folder, .nrrd, .nii, .mha, zip), text rows x y z gray, case, or session: the "
          "bone that it left; with --check alone a mesh file")
      ->required();
  command->add_option("--out", options->out, "FILE.inp for Abaqus and CalculiX, or FILE.vtu for VTK");
  command->add_option("--upsample", options->upsample, "Parts of a voxel per axis")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  options->modulus.add_to(*command);
  command->add_option("--poisson", options->poisson, "Poisson's ratio")->capture_default_str();
  command->add_option("--bins", options->bin_width_mpa, "Put moduli into bins of this width, MPa");
  command
      ->add_option("--bin-value", options->bin_value, "What stands for a bin: its centre, or the mean in it")
      ->check(CLI::IsMember({"centre", "mean"}))
      ->capture_default_str();
  command->add_option("--threshold", options->threshold,
                      "Least gray value (cases and sessions: density, g/cc) that is bone. Default: volumes "
                      "above 0, else all");
  command->add_flag("--keep-islands", options->keep_islands,
                    "Keep what does not hang together with the largest part");
  command->add_flag("--node-sets", options->node_sets, "Node sets XMIN to ZMAX on the six faces");
  command
      ->add_option("--compress", options->axis, "Node sets and a ready step of compression along x, y or z")
      ->check(CLI::IsMember({"x", "y", "z"}));
  command->add_option("--strain-percent", options->strain_percent, "Of that step")->capture_default_str();
  command->add_option("--platens", options->platens, "Of that step: sliding or fixed")
      ->check(CLI::IsMember({"sliding", "fixed"}))
      ->capture_default_str();
  command
      ->add_option("--memory-mb", options->memory_mb, "Stay below this; what does not fit goes to the disk")
      ->check(CLI::Range(64, 1 << 20));
  command->add_flag("--check", options->check, "Read the file again and hold it against the voxels");
  command->add_option("--case", options->case_name,
                      "Case folder of a session, where it is not in the data folder");
  command->callback([options, &global] { femesh(*options, global); });
}

}  // namespace ream::app
