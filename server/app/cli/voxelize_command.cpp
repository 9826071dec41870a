#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "core/error.hpp"
#include "geometry/mesh_io.hpp"
#include "shell/surface_voxelizer_cl.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

struct Options {
  fs::path mesh, points;
  double size_mm = 0.0;
  int separability = 26;
  std::string backend = "auto";
};

struct Result {
  shell::SurfaceVoxels grid;
  double time_ms = 0.0;  ///< of marking the cells; reading the mesh and preparing the device are not in it
  std::string backend;
};

Result voxelize(const Options& options) {
  if (!(options.size_mm > 0.0)) throw Error(ErrorKind::usage, "--size must be a positive voxel edge in mm");
  const TriangleMesh mesh = load_mesh(options.mesh);
  const auto separability =
      options.separability == 6 ? shell::Separability::six : shell::Separability::twenty_six;
  Result result{shell::surface_grid(mesh, options.size_mm), 0.0, "cpu"};
  const auto timed = [&](const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    result.time_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  };
  if (options.backend == "auto" || options.backend == "cpu") {
    timed([&] { shell::voxelize_surface_cpu(mesh, separability, result.grid); });
  } else if (options.backend.starts_with("opencl")) {
    const gpu::Queue queue(gpu::choose_device(options.backend, gpu::Use::bulk));
    result.backend = "opencl: " + queue.device().name;
    shell::SurfaceVoxelizerCl voxelizer(queue);
    timed([&] { voxelizer.voxelize(mesh, separability, result.grid); });
  } else {
    throw Error(ErrorKind::usage, "--backend '" + options.backend + "' is not auto, cpu, opencl or opencl:N");
  }
  return result;
}

/// Centres of the filled cells, mm, frame of the mesh file.
TriangleMesh centres(const shell::SurfaceVoxels& grid) {
  TriangleMesh cloud;
  cloud.vertices_mm.reserve(grid.filled_cells());
  for (int w = 0; w < grid.dims.z(); ++w)
    for (int v = 0; v < grid.dims.y(); ++v)
      for (int u = 0; u < grid.dims.x(); ++u)
        if (grid.filled(u, v, w))
          cloud.vertices_mm.push_back(
              (grid.origin_mm + grid.size_mm * Vec3(u + 0.5, v + 0.5, w + 0.5)).cast<float>());
  return cloud;
}

void run(const Options& options, const GlobalOptions& global) {
  const Result result = voxelize(options);
  if (!options.points.empty()) write_ply(options.points, centres(result.grid));
  const size_t voxels = result.grid.filled_cells();
  const Vec3i& dims = result.grid.dims;
  if (global.json) {
    const nlohmann::json report = {{"voxels", voxels},
                                   {"dims", {dims.x(), dims.y(), dims.z()}},
                                   {"time_ms", result.time_ms},
                                   {"size_mm", result.grid.size_mm},
                                   {"separability", options.separability},
                                   {"backend", result.backend}};
    std::cout << report.dump() << '\n';
    return;
  }
  std::cout << voxels << " voxels in a grid of " << dims.x() << " x " << dims.y() << " x " << dims.z() << ", "
            << result.time_ms << " ms on " << result.backend << '\n';
}

}  // namespace

void add_voxelize_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("voxelize", "Mark the voxels that the surface of a triangle mesh passes");
  command->add_option("MESH", options->mesh, "STL, OBJ, PLY or GLB file, in mm")->required();
  command->add_option("--size", options->size_mm, "Voxel edge, mm")->required();
  command
      ->add_option("--separability", options->separability,
                   "26: every voxel the surface touches; 6: the thin form")
      ->check(CLI::IsMember({6, 26}))
      ->capture_default_str();
  command->add_option("--points", options->points, "Write the centres of the marked voxels to this PLY file");
  command->add_option("--backend", options->backend, "auto, cpu, opencl or opencl:N; the voxels are the same")
      ->capture_default_str();
  command->callback([options, &global] { run(*options, global); });
}

}  // namespace ream::app
