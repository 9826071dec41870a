#include <time.h>

#include <algorithm>
#include <memory>

#include "bench/bench.hpp"
#include "bench/flying_edges.hpp"
#include "bench/seated_reaming.hpp"
#include "core/clock.hpp"
#include "ct/phantom/phantom_case.hpp"
#include "sim/step.hpp"
#include "stream/mesh_publisher.hpp"
#include "stream/messages.hpp"
#include "surface/block_mesh.hpp"
#include "voxel/bricks.hpp"

namespace ream::bench {
namespace {

constexpr uint32_t update_ticks = 33, seated_from_tick = 2000;
constexpr double goal_mean_us = 5000.0, goal_p99_us = 12000.0, goal_bytes_s = 2e6;
constexpr double thesis_update_us = 21700.0;  ///< its graphic frame, section 5.4.2, on a GTX 970
/// Cortical bone of the thesis' simulator: 52 N / (2000 N s/mm) = 0.026 mm/s, which eq. 5.1 gives at 1.68
/// g/cc.
constexpr uint8_t cortical_code = 168;
constexpr double goal_speed_over_vtk = 1.3;
constexpr int threads = 2, whole_runs = 9;

/// Of the calling thread: what one core has to give, also while other programs take their share.
double processor_us() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
}

struct Seated {
  std::vector<double> update_us, wall_us;  ///< one per 33 ms in contact
  double pictures_per_s = 0.0;
  double bytes_per_s = 0.0, blocks_per_s = 0.0, feed_mm_s = 0.0;
};

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

double percentile(std::vector<double> values, double fraction) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  return values[static_cast<size_t>(fraction * last + 0.5)];
}

/// The session of the case in virtual time; after every 33 ticks the publisher takes in the bricks, extracts
/// and encodes. Updates count from two seconds on, when the reamer sits in the bone.
Seated measure_seated(case_::Case bone_case) {
  const device::Script script = seated_script();
  const sim::Model model = sim::make_model(
      *bone_case.plan, bone_case.bone, shell::make_tool(shell::thesis_tool), seated_settings(script, "cpu"));
  sim::State state(model, bone_case.bone);
  voxel::BrickRing ring(8192);
  voxel::BrickSender sender(bone_case.bone.grid, ring);
  state.brick_sender = &sender;
  stream::Fanout fanout;
  const auto viewer = fanout.subscribe({}, 1);
  stream::MeshPublisher publisher(bone_case.bone, fanout);
  publisher.publish_all();
  viewer->take();

  const auto device = device::make_scripted_device(script, model.world_from_plan);
  device->open();
  Seated seated;
  device::DeviceInput input;
  sim::TickReport report;
  double bytes = 0.0, blocks = 0.0, pictures = 0.0, seconds = 0.0;
  std::vector<double> feeds;
  while (device->read(input) == device::DeviceStatus::ok) {
    if (sim::step(model, state, input, report) != sim::StepStatus::ok) break;
    device->write(sim::output_of(report));
    if (state.tick % update_ticks != 0) continue;
    const auto start = SteadyClock::now();
    const double start_us = processor_us();
    for (voxel::BrickImage image; ring.try_pop(image);) publisher.take(image, state.tick * tick_ns);
    publisher.poll(state.tick * tick_ns);
    const double us = processor_us() - start_us, wall_us = elapsed_us(start);
    const std::vector<stream::SharedBlock> sent = viewer->take().blocks;
    if (state.tick > seated_from_tick) {
      seated.update_us.push_back(us);
      seated.wall_us.push_back(wall_us);
      pictures += sent.empty() ? 0.0 : 1.0;
      if (!sent.empty()) bytes += static_cast<double>(mesh_message(sent, false)->size());
      blocks += static_cast<double>(sent.size());
      seconds += update_ticks * tick_s;
      feeds.push_back(report.feed_rate_mm_s);
    }
  }
  device->close();
  seated.bytes_per_s = bytes / seconds;
  seated.blocks_per_s = blocks / seconds;
  seated.pictures_per_s = pictures / seconds;
  seated.feed_mm_s = mean_of(feeds);
  return seated;
}

void add_seated(const std::string& name, const Seated& seated, double bytes_goal, std::vector<Row>& rows) {
  const auto add = [&](const std::string& what, double ours, const std::string& unit, double goal = 0.0,
                       double baseline = 0.0) {
    rows.push_back({"surface", name + " " + what, ours, baseline, unit, goal});
  };
  add("update, mean", mean_of(seated.update_us), "us", goal_mean_us, thesis_update_us);
  add("update, p50", percentile(seated.update_us, 0.5), "us");
  add("update, p99", percentile(seated.update_us, 0.99), "us", goal_p99_us);
  add("update, wall, mean", mean_of(seated.wall_us), "us");
  add("update, wall, p99", percentile(seated.wall_us, 0.99), "us");
  add("stream", seated.bytes_per_s, "B/s", bytes_goal);
  add("blocks", seated.blocks_per_s, "1/s");
  add("pictures", seated.pictures_per_s, "1/s");
  add("feed", seated.feed_mm_s, "mm/s");
}

/// The same within a layer of empty voxels, so that VTK closes the surface at the grid's sides as we do.
std::vector<uint8_t> padded(const Vec3i& dims, const std::vector<uint8_t>& rows) {
  const Vec3i wide = dims.array() + 2;
  std::vector<uint8_t> result(static_cast<size_t>(wide.x()) * static_cast<size_t>(wide.y()) *
                              static_cast<size_t>(wide.z()));
  const auto row = static_cast<size_t>(dims.x());
  for (int w = 0; w < dims.z(); ++w)
    for (int v = 0; v < dims.y(); ++v) {
      const size_t from = row * static_cast<size_t>(v + dims.y() * w);
      const size_t to = 1 + static_cast<size_t>(wide.x()) * static_cast<size_t>(v + 1 + wide.y() * (w + 1));
      std::copy_n(rows.begin() + static_cast<ptrdiff_t>(from), row,
                  result.begin() + static_cast<ptrdiff_t>(to));
    }
  return result;
}

/// The whole grid, ours and VTK's in turn so that both meet the same disturbances; medians.
void add_whole(const voxel::BoneModel& bone, std::vector<Row>& rows) {
  std::vector<uint8_t> coverage_rows = voxel::rows_from_bricks(bone.grid, bone.coverage);
  const Vec3i& dims = bone.grid.dims;
  std::vector<double> ours, bare, with_normals;
  size_t our_triangles = 0;
  for (int run = 0; run < whole_runs; ++run) {
    const auto start = SteadyClock::now();
    our_triangles = surface::whole_surface(bone.grid, bone.coverage.data(), threads).triangles.size();
    ours.push_back(elapsed_us(start) / 1000.0);
    for (const bool normals : {false, true})
      if (const auto vtk =
              run_flying_edges({dims.x(), dims.y(), dims.z()}, coverage_rows, normals, threads)) {
        (normals ? with_normals : bare).push_back(vtk->ms);
      }
  }
  const double ms = percentile(ours, 0.5);
  const double normals_ms = percentile(with_normals, 0.5), bare_ms = percentile(bare, 0.5);
  const std::string name = "thesis-5-4-2 whole, 2 threads";
  if (with_normals.empty()) {
    rows.push_back({"surface", name + " (built without VTK)", ms, 0.0, "ms", 0.0});
  } else {
    rows.push_back(
        {"surface", name + ", VTK with normals", ms, normals_ms, "ms", normals_ms / goal_speed_over_vtk});
    rows.push_back({"surface", name + ", VTK without", ms, bare_ms, "ms", 0.0});
  }
  std::vector<uint8_t> closed = padded(dims, coverage_rows);
  const auto vtk = run_flying_edges({dims.x() + 2, dims.y() + 2, dims.z() + 2}, closed, false, threads);
  rows.push_back({"surface", name + ", triangles (VTK's closed too)", static_cast<double>(our_triangles),
                  vtk ? static_cast<double>(vtk->triangles) : 0.0, "", 0.0});
}

}  // namespace

std::vector<Row> surface_suite(const Options&) {
  const ct::PhantomPreset preset = ct::phantom_preset("thesis-5-4-2");
  case_::Case bone_case = ct::make_phantom_case("thesis-5-4-2", preset.params, preset.upsample);
  std::vector<Row> rows;
  add_whole(bone_case.bone, rows);
  add_seated("thesis-5-4-2 seated", measure_seated(bone_case), 0.0, rows);
  std::fill(bone_case.bone.density.writable().begin(), bone_case.bone.density.writable().end(),
            cortical_code);
  add_seated("thesis-5-4-2 cortical", measure_seated(std::move(bone_case)), goal_bytes_s, rows);
  return rows;
}

}  // namespace ream::bench
