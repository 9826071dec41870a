#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <memory>

#include "app/cli/commands.hpp"
#include "app/cli/terminal_progress.hpp"
#include "app/numbers.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "geometry/mesh_io.hpp"
#include "voxelizer/voxel_files.hpp"
#include "voxelizer/voxelizer.hpp"
#include "voxelizer/voxelizer_cl.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

struct VoxelizeOptions {
  fs::path mesh, like, points, grid, morton, boxes;
  std::string size, origin;
  double scale = 1.0;
  int separability = 26, memory_mb = static_cast<int>(voxelizer::default_dense_bytes >> 20);
  bool solid = false, with_surface = false, bits = false;
  std::string backend = "auto";
};

struct Result {
  voxelizer::VoxelSet set;
  double time_ms = 0.0;  ///< of marking the voxels; reading the mesh and preparing the device are not in it
  std::string backend = "cpu";
};

Vec3 voxel_size(const std::string& text) {
  const bool one = text.find(',') == std::string::npos;
  const std::vector<double> n = parse_numbers(text, one ? 1 : 3, "--size");
  for (const double edge : n)
    if (!(edge > 0.0))
      throw Error(ErrorKind::usage, "--size must be a positive voxel edge in mm, or three: X,Y,Z");
  return one ? Vec3::Constant(n[0]) : Vec3(n[0], n[1], n[2]);
}

voxelizer::RasterGrid grid_for(const VoxelizeOptions& options, const Aabb& box_mm) {
  if (!options.like.empty()) {
    if (!options.size.empty() || !options.origin.empty())
      throw Error(ErrorKind::usage, "--like says voxel size and origin; leave out --size and --origin");
    return voxelizer::grid_of_nrrd(options.like);
  }
  if (options.size.empty()) throw Error(ErrorKind::usage, "--size or --like is required");
  const Vec3 size_mm = voxel_size(options.size);
  if (options.origin.empty()) return voxelizer::grid_around(box_mm, size_mm);
  const std::vector<double> o = parse_numbers(options.origin, 3, "--origin");
  return voxelizer::grid_from(Vec3(o[0], o[1], o[2]), box_mm, size_mm);
}

voxelizer::Request request_of(const VoxelizeOptions& options) {
  voxelizer::Request request;
  request.separability =
      options.separability == 6 ? voxelizer::Separability::six : voxelizer::Separability::twenty_six;
  request.solid = options.solid;
  request.surface = !options.solid || options.with_surface;
  request.scale = options.scale;
  return request;
}

template <class AVoxelizer>
void mark(AVoxelizer& marker, const TriangleMesh& mesh, const voxelizer::Request& request, Result& result) {
  const TerminalProgress progress;
  const auto start = std::chrono::steady_clock::now();
  marker.voxelize(mesh, request, result.set, std::cref(progress));
  result.time_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

Result voxelize(const VoxelizeOptions& options, const TriangleMesh& mesh, const voxelizer::Request& request) {
  const Aabb box = voxelizer::used_bounds(mesh, options.scale);
  const voxelizer::RasterGrid grid = grid_for(options, box);
  voxelizer::check_reach(grid, box);
  if (options.solid) voxelizer::require_closed(mesh, options.scale);
  Result result{voxelizer::VoxelSet(grid, static_cast<size_t>(options.memory_mb) << 20)};
  if (options.backend == "auto" || options.backend == "cpu") {
    voxelizer::Voxelizer marker;
    mark(marker, mesh, request, result);
  } else if (options.backend.starts_with("opencl")) {
    const gpu::Queue queue(gpu::choose_device(options.backend, gpu::Use::bulk));
    voxelizer::VoxelizerCl marker(queue);
    result.backend = "opencl: " + queue.device().name;
    mark(marker, mesh, request, result);
  } else {
    throw Error(ErrorKind::usage, "--backend '" + options.backend + "' is not auto, cpu, opencl or opencl:N");
  }
  return result;
}

/// The files that were asked for, all written before the first takes its name.
class Outputs {
 public:
  /// Begins the files, so that a place where none can be written is known before the work.
  explicit Outputs(const VoxelizeOptions& options) {
    begin(options.grid, grid_);
    begin(options.points, points_);
    begin(options.morton, morton_);
    begin(options.boxes, boxes_);
  }

  void write(const VoxelizeOptions& options, const TriangleMesh& mesh, const voxelizer::Request& request,
             const voxelizer::VoxelSet& set) {
    const TerminalProgress terminal;
    const Progress progress = std::cref(terminal);
    using voxelizer::GridFormat;
    if (grid_)
      voxelizer::write_nrrd(set, options.bits ? GridFormat::bits : GridFormat::bytes, *grid_, progress);
    if (points_) voxelizer::write_points(mesh, request, set, *points_, progress);
    if (morton_) voxelizer::write_morton_codes(set, *morton_, progress);
    if (boxes_) voxelizer::write_boxes(set, *boxes_, progress);
    for (const auto& file : {&grid_, &points_, &morton_, &boxes_})
      if (*file) (*file)->finish();
    throw_if_interrupted();
    for (const auto& file : {&grid_, &points_, &morton_, &boxes_})
      if (*file) (*file)->commit();
  }

 private:
  static void begin(const fs::path& path, std::unique_ptr<AtomicFile>& file) {
    if (!path.empty()) file = std::make_unique<AtomicFile>(path);
  }
  std::unique_ptr<AtomicFile> grid_, points_, morton_, boxes_;
};

void check_names(const VoxelizeOptions& options) {
  if (options.bits && options.grid.empty()) throw Error(ErrorKind::usage, "--bits is for --grid FILE.nrrd");
  const std::vector<fs::path> names = {options.grid, options.points, options.morton, options.boxes};
  for (size_t i = 0; i < names.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if (!names[i].empty() && names[i] == names[j])
        throw Error(ErrorKind::usage, "two outputs have the name " + names[i].string());
}

void report(const VoxelizeOptions& options, const Result& result, bool as_json) {
  const voxelizer::VoxelSet& set = result.set;
  const Vec3i& d = set.grid().dims;
  const Vec3 &s = set.grid().size_mm, &o = set.grid().origin_mm;
  if (as_json) {
    std::cout << nlohmann::json{{"voxels", set.filled()},
                                {"dims", {d.x(), d.y(), d.z()}},
                                {"size_mm", {s.x(), s.y(), s.z()}},
                                {"origin_mm", {o.x(), o.y(), o.z()}},
                                {"time_ms", result.time_ms},
                                {"separability", options.separability},
                                {"solid", options.solid},
                                {"kept_as", set.sparse() ? "bricks" : "bits"},
                                {"memory_mb", static_cast<double>(set.bytes()) / 1e6},
                                {"backend", result.backend}}
                     .dump()
              << '\n';
    return;
  }
  std::cout << set.filled() << " voxels in a grid of " << d.x() << " x " << d.y() << " x " << d.z()
            << (set.sparse() ? ", kept as sparse bricks, " : ", ") << result.time_ms << " ms on "
            << result.backend << '\n';
}

void run(const VoxelizeOptions& options, const GlobalOptions& global) {
  catch_interrupts();
  check_names(options);
  if (!(options.scale > 0.0)) throw Error(ErrorKind::usage, "--scale must be a positive number");
  if (!options.size.empty()) voxel_size(options.size);
  const TriangleMesh mesh = load_mesh(options.mesh);
  throw_if_interrupted();
  Outputs outputs(options);
  const voxelizer::Request request = request_of(options);
  const Result result = voxelize(options, mesh, request);
  outputs.write(options, mesh, request, result.set);
  report(options, result, global.json);
}

}  // namespace

void add_voxelize_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<VoxelizeOptions>();
  CLI::App* command = app.add_subcommand(
      "voxelize", "Mark the voxels that the surface of a triangle mesh passes, or fill it");
  command->add_option("MESH", options->mesh, "STL, OBJ, PLY, OFF or GLB file, in mm unless --scale is given")
      ->required();
  command->add_option("--size", options->size, "Voxel edge in mm, or three: X,Y,Z");
  command->add_option("--scale", options->scale, "Millimetres for one unit of the mesh")
      ->capture_default_str();
  command->add_option("--origin", options->origin,
                      "X,Y,Z, mm: a corner that voxels have in common; the grid still goes around the mesh. "
                      "Default: half a voxel before the mesh's box");
  command->add_option("--like", options->like,
                      "Take size, origin and dimensions of the grid from this NRRD file");
  CLI::Option* separability =
      command
          ->add_option(
              "--separability", options->separability,
              "26: every voxel the surface touches; 6: the thin form. With --solid: add the surface, too")
          ->check(CLI::IsMember({6, 26}))
          ->capture_default_str();
  command->add_flag("--solid", options->solid,
                    "Fill a closed mesh: voxels whose centre is inside, cavities left empty");
  command->add_option("--grid", options->grid, "Write the grid to this NRRD file, a byte a voxel");
  command->add_flag("--bits", options->bits, "In the NRRD file a bit a voxel, eight along x in a byte");
  command->add_option("--points", options->points,
                      "Write centres, normals and areas of the marked voxels to this PLY file");
  command->add_option("--morton", options->morton, "Write their Morton codes to this NRRD file");
  command->add_option("--boxes", options->boxes, "Write them as boxes to look at to this PLY file");
  command
      ->add_option("--memory-mb", options->memory_mb,
                   "Grids whose bits take more than this are kept as sparse bricks")
      ->check(CLI::Range(0, 1 << 20))
      ->capture_default_str();
  command->add_option("--backend", options->backend, "auto, cpu, opencl or opencl:N; the voxels are the same")
      ->capture_default_str();
  command->callback([options, &global, separability] {
    options->with_surface = separability->count() > 0;
    run(*options, global);
  });
}

}  // namespace ream::app
