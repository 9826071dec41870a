#include <sys/resource.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "bench/bench.hpp"
#include "core/clock.hpp"
#include "fe/make_mesh.hpp"
#include "solve/bone_compression.hpp"
#include "support/temporary_folder.hpp"

namespace ream::bench {
namespace {

/// What `ream solve` is held to, on two cores.
constexpr double time_goal_s = 60.0, memory_goal_mb = 2000.0, calculix_goal = 30.0;

/// Voxels of 50 um, of 10,000 to 11,000 MPa at random.
fe::ElementModel model_of(int edge, const std::function<bool(double, double, double)>& is_bone) {
  fe::ElementModel model;
  model.spacing_mm = Vec3::Constant(0.05);
  MemoryBudget budget;
  const auto read = [&](int w, std::span<int32_t> codes) {
    std::mt19937 random(static_cast<unsigned>(w));
    size_t i = 0;
    for (int v = 0; v < edge; ++v)
      for (int u = 0; u < edge; ++u, ++i)
        codes[i] = is_bone(u, v, w) ? static_cast<int32_t>(10000 + random() % 1000) : fe::no_element;
  };
  fe::fill_from_layers(model, Vec3i::Constant(edge), read, budget);
  return model;
}

fe::ElementModel block(int edge) {
  return model_of(edge, [](double, double, double) { return true; });
}

/// A gyroid of struts and pores as those of spongy bone are: 1.2 mm from one to the next, a fifth of it
/// solid.
fe::ElementModel foam(int edge) {
  constexpr double turn = 2.0 * 3.14159265358979 / 24.0;
  return model_of(edge, [](double x, double y, double z) {
    const double g = std::sin(turn * x) * std::cos(turn * y) + std::sin(turn * y) * std::cos(turn * z) +
                     std::sin(turn * z) * std::cos(turn * x);
    return g > 0.9;
  });
}

solve::CompressionRequest request() {
  solve::CompressionRequest asked;
  asked.rule.law = fe::linear_law(0.0, 1.0);
  return asked;
}

struct Timed {
  solve::CompressionResult result;
  double seconds = 0.0;
};

Timed solved(fe::ElementModel model, const solve::CompressionRequest& asked = request()) {
  MemoryBudget budget;
  const auto start = SteadyClock::now();
  Timed timed{solve::compress(std::move(model), asked, budget)};
  timed.seconds = elapsed_us(start) * 1e-6;
  return timed;
}

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024e-6;
}

std::vector<Row> rows_of(const std::string& name, const Timed& timed) {
  const std::string of = name + " of " + std::to_string(timed.result.elements) + " elements";
  return {{"solve", of, timed.seconds, 0.0, "s", time_goal_s},
          {"solve", of + ", iterations", static_cast<double>(timed.result.iterations), 0.0, ""},
          {"solve", of + ", residual", timed.result.relative_residual, 0.0, "", 1e-6},
          {"solve", of + ", peak memory so far", peak_mb(), 0.0, "MB", memory_goal_mb}};
}

/// A graphics processor where there is one.
gpu::Device bench_device() {
  for (const gpu::Device& device : gpu::list_devices())
    if (!device.is_cpu) return device;
  return gpu::choose_device("auto", gpu::Use::bulk);
}

/// What a device is given to do in so many iterations, and before them.
gpu::Traffic traffic_of(const gpu::Queue& queue, int edge, int iterations) {
  solve::CompressionRequest asked = request();
  asked.limits = {.tolerance = 1e-30, .max_iterations = iterations, .queue = &queue};
  const gpu::Traffic before = queue.traffic();
  solved(foam(edge), asked);
  const gpu::Traffic& after = queue.traffic();
  return {after.launches - before.launches, after.bytes_to_device - before.bytes_to_device,
          after.bytes_from_device - before.bytes_from_device};
}

/// The same foam on the processor and on a device, and what goes there and back.
std::vector<Row> beside_opencl(int edge) {
  const gpu::Queue queue(bench_device());
  solve::CompressionRequest asked = request();
  const Timed ours = solved(foam(edge), asked);
  asked.limits.queue = &queue;
  const Timed theirs = solved(foam(edge), asked);
  const gpu::Traffic few = traffic_of(queue, edge, 2), more = traffic_of(queue, edge, 6);
  const auto of_iteration = [](uint64_t a, uint64_t b) { return static_cast<double>(b - a) / 4.0; };
  const double there = of_iteration(few.bytes_to_device, more.bytes_to_device),
               back = of_iteration(few.bytes_from_device, more.bytes_from_device);
  const std::string of =
      "foam of " + std::to_string(ours.result.elements) + " elements, " + queue.device().name;
  return {{"solve", of, theirs.seconds, ours.seconds, "s"},
          {"solve", of + ": times as long as the processor", theirs.seconds / ours.seconds, 0.0, ""},
          {"solve", of + ": launches an iteration", of_iteration(few.launches, more.launches), 0.0, ""},
          {"solve", of + ": put there before",
           (static_cast<double>(few.bytes_to_device) - 2.0 * there) * 1e-6, 0.0, "MB"},
          {"solve", of + ": there and back an iteration", (there + back) * 1e-6, 0.0, "MB"}};
}

/// The same elements by CalculiX's direct solver on two threads; nothing where it is not installed.
std::vector<Row> beside_calculix(int edge) {
  if (std::system("command -v ccx >/dev/null 2>&1") != 0) return {};
  const test::TemporaryFolder folder;
  fe::MeshOptions options;
  options.rule = request().rule;
  options.rule.bin_width_mpa = 1.0;
  options.inp.compression = fe::Compression{};
  MemoryBudget budget;
  fe::make_mesh(block(edge), options, budget, folder.path() / "job.inp");
  const auto start = SteadyClock::now();
  if (std::system(("cd " + folder.path().string() + " && OMP_NUM_THREADS=2 ccx job >job.log 2>&1").c_str()) !=
      0)
    return {};
  const double theirs_s = elapsed_us(start) * 1e-6;
  const Timed ours = solved(block(edge));
  const std::string name = "CalculiX, block of " + std::to_string(ours.result.elements) + " elements";
  return {
      {"solve", name, ours.seconds, theirs_s, "s"},
      {"solve", name + ": times as long", theirs_s / ours.seconds, 0.0, "", calculix_goal, Goal::at_least}};
}

}  // namespace

std::vector<Row> solve_suite(const Options& options) {
  std::vector<Row> rows = rows_of("block", solved(block(126)));
  for (const Row& row : rows_of("foam", solved(foam(212)))) rows.push_back(row);
  for (const Row& row : beside_opencl(80)) rows.push_back(row);
  if (options.baselines)
    for (const Row& row : beside_calculix(40)) rows.push_back(row);
  return rows;
}

}  // namespace ream::bench
