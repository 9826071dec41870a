#include <algorithm>
#include <cmath>
#include <fstream>
#include <ostream>

#include "bench/femesh/femesh_run.hpp"
#include "bench/femesh/femesh_suite.hpp"
#include "bench/femesh/our_mesh.hpp"
#include "bench/text_table.hpp"

namespace ream::bench {
namespace {

constexpr double bin_width_mpa = 10.0;  // section 2.5.1
constexpr double goal_over_hash_map = 20.0, goal_seconds_from_rows = 4.0, goal_share_of_plain_write = 0.5;
constexpr double baseline_bytes_an_element = 400.0;  // of the thesis' pipeline, nodes and hash map together
constexpr int femesh_runs = 3;
constexpr const char* phase_names[] = {"create grid",        "create hexahedra", "nodes indexing",
                                       "calculate material", "material binning", "material indexing"};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

OurMesh median_mesh(const Foam& foam, int upsample, double bin_width) {
  std::vector<OurMesh> all;
  for (int i = 0; i < femesh_runs; ++i) all.push_back(our_mesh(foam, upsample, bin_width));
  std::sort(all.begin(), all.end(),
            [](const OurMesh& a, const OurMesh& b) { return a.sum_ms() < b.sum_ms(); });
  return all[all.size() / 2];
}

double memory_available() {
  std::ifstream in("/proc/meminfo");
  for (std::string key; in >> key;) {
    if (key != "MemAvailable:") continue;
    double kib = 0.0;
    in >> kib;
    return kib * 1024.0;
  }
  return 0.0;
}

/// Table 2.1: unique nodes of a block of voxels.
void add_table_2_1(const Options& options, std::vector<Row>& rows) {
  constexpr double thesis[5][4] = {{500, 853, 2.70, 0.21},
                                   {1000, 833, 10.48, 0.44},
                                   {5000, 6265, 162.17, 1.80},
                                   {15000, 18877, 1592.70, 6.18},
                                   {40000, 49887, 10986.82, 15.42}};
  const Vec3i blocks[5] = {{10, 10, 5}, {10, 10, 10}, {20, 25, 10}, {30, 25, 20}, {40, 40, 25}};
  TextTable table{
      "Table 2.1: unique nodes and milliseconds. The thesis' 1,000 voxels cannot have 833: a full block, "
      "which has fewest, has 1,331",
      "voxels",
      {"thesis nodes", "nodes", "thesis loops", "loops", "thesis hash", "hash", "numbering"},
      {}};
  for (int i = 0; i < 5; ++i) {
    const Foam block(blocks[i], Vec3::Constant(0.032), 1e9);  // everything is wall
    const std::vector<std::array<float, 3>> nodes = nodes_of(block.rows(), block.spacing_mm());
    std::vector<uint32_t> index;
    const Indexed hash = index_by_hash_map(nodes, index), loops = index_by_nested_loops(nodes);
    const OurMesh ours = our_numbering(block);
    const double ms = ours.numbering_ms + ours.explicit_ms;
    table.lines.push_back(
        {std::to_string(block.voxels()),
         {thesis[i][1], static_cast<double>(ours.nodes), thesis[i][2], loops.ms, thesis[i][3], hash.ms, ms}});
    if (loops.nodes != ours.nodes || hash.nodes != ours.nodes)
      rows.push_back(
          {"femesh", "table 2.1: nodes that differ from nested loops or hash map", 1.0, 0.0, "", 0.5});
    if (i == 4)
      rows.push_back({"femesh", "table 2.1: nodes of 40,000 voxels, baseline: hash map", ms, hash.ms, "ms"});
  }
  table.print(options.tables, 2);
}

/// Tables 2.2 to 2.4 for one model.
void add_model(const ThesisModel& model, const Options& options, const BenchFolder& folder, TextTable& memory,
               std::vector<Row>& rows) {
  const Foam foam(model.dims, model.spacing_mm, model.voxels);
  const double bins = model.binned ? bin_width_mpa : 0.0;
  const OurMesh ours = median_mesh(foam, 1, bins);
  ThesisMesh thesis;
  const double needed = static_cast<double>(foam.voxels()) * baseline_bytes_an_element;
  const bool compare = options.baselines && needed < 0.8 * memory_available();
  if (compare) thesis = thesis_mesh(foam.rows(), foam.dims(), foam.spacing_mm(), 1.0, bins);
  const std::string name = model.name;
  if (options.baselines && !compare && options.tables != nullptr)
    *options.tables << name << ": the thesis' pipeline was left out, as it needs about " << needed / 1e9
                    << " GB\n";
  const double here[6] = {thesis.grid_ms,     thesis.hexahedra_ms, thesis.indexing_ms,
                          thesis.material_ms, thesis.binning_ms,   thesis.sets_ms};
  const double own[6] = {ours.grid_ms, ours.explicit_ms, ours.numbering_ms, ours.materials_ms,
                         0.0,          ours.sets_ms};
  TextTable table{"Table 2.3, " + name + ": " + std::to_string(foam.voxels()) +
                      " voxels, milliseconds; ours finds " + "components too, and bins as it makes materials",
                  "phase",
                  {"thesis", "its method", "ours"},
                  {}};
  for (int i = 0; i < 6; ++i)
    table.lines.push_back({phase_names[i], {model.thesis_phases_ms[i], here[i], own[i]}});
  table.lines.push_back({"components", {NAN, NAN, ours.components_ms}});
  table.lines.push_back({"sum", {model.thesis_sum_ms, compare ? thesis.sum_ms() : NAN, ours.sum_ms()}});
  table.print(options.tables, 1);
  const bool big = model.voxels > 1e7;
  rows.push_back({"femesh", name + ": compute phases, baseline: the thesis' pipeline", ours.sum_ms(),
                  compare ? thesis.sum_ms() : 0.0, "ms"});
  if (compare)
    rows.push_back({"femesh", name + ": compute phases, times faster than the hash map",
                    thesis.sum_ms() / ours.sum_ms(), 0.0, "", big ? goal_over_hash_map : 0.0,
                    Goal::at_least});
  if (compare)
    rows.push_back({"femesh", name + ": compute phases, times faster than hash maps with room on two threads",
                    (thesis.sum_ms() - thesis.indexing_ms + thesis.fair_indexing_ms) / ours.sum_ms(), 0.0, "",
                    0.0, Goal::at_least});

  const std::filesystem::path text = folder.path() / "rows.txt", inp = folder.path() / "mesh.inp";
  foam.write_rows(text);
  std::vector<double> total_s, share, write_mb_s;
  double peak_mb = 0.0;
  for (int i = 0; i < femesh_runs; ++i) {
    const auto report = run_femesh(text.string() + " --modulus 0,1 --bins 10 --out " + inp.string());
    const auto bytes = report["bytes"].get<uint64_t>();
    const double write_s = report["phases_ms"]["write"].get<double>() * 1e-3;
    total_s.push_back(report["time_ms"].get<double>() * 1e-3);
    peak_mb = std::max(peak_mb, report["peak_memory_mb"].get<double>());
    std::filesystem::remove(inp);
    share.push_back(plain_write_s(inp, bytes) / write_s);
    write_mb_s.push_back(static_cast<double>(bytes) / 1e6 / write_s);
  }
  const double text_mb = static_cast<double>(std::filesystem::file_size(text)) / 1e6;
  std::filesystem::remove(text);
  const double goal_mb = model.voxels > 3e7 ? 2000.0 : big ? 1000.0 : 0.0;
  rows.push_back({"femesh", name + ": peak memory from text rows to .inp, baseline: thesis", peak_mb,
                  model.thesis_memory_mb, "MB", goal_mb});
  rows.push_back({"femesh", name + ": text rows to .inp", median(total_s), 0.0, "s",
                  std::abs(model.voxels - 12.4e6) < 1e6 ? goal_seconds_from_rows : 0.0});
  rows.push_back({"femesh", name + ": writing, share of the speed of a plain write", median(share), 0.0, "",
                  big ? goal_share_of_plain_write : 0.0, Goal::at_least});
  memory.lines.push_back(
      {name, {text_mb, model.thesis_memory_mb, peak_mb, median(total_s), median(write_mb_s)}});
}

/// Table 2.5: the cancellous core with every voxel split in eight.
void add_upsampling(const Options& options, std::vector<Row>& rows) {
  const ThesisModel& core = thesis_models()[1];
  const Foam foam(core.dims, core.spacing_mm, core.voxels);
  const OurMesh ours = median_mesh(foam, 2, 0.0);
  TextTable table{"Table 2.5, upsampled by 2: " + std::to_string(ours.elements) + " elements, milliseconds",
                  "phase",
                  {"thesis", "ours"},
                  {}};
  table.lines = {{"create grid", {23.16, ours.grid_ms}},
                 {"resizing voxels", {4542.85, ours.upsample_ms}},
                 {"create hexahedra", {1470.70, ours.explicit_ms}},
                 {"nodes indexing", {11330.33, ours.numbering_ms}},
                 {"calculate material", {122.16, ours.materials_ms}},
                 {"material indexing", {3255.17, ours.sets_ms}},
                 {"components", {NAN, ours.components_ms}},
                 {"sum", {20744.37, ours.sum_ms()}}};
  table.print(options.tables, 1);
  rows.push_back({"femesh", "cancellous core upsampled by 2: compute phases, baseline: thesis", ours.sum_ms(),
                  20744.37, "ms"});
}

/// Figure 2.4: time over voxels; the slope of its log-log line.
void add_figure_2_4(const Options& options, std::vector<Row>& rows) {
  TextTable table{"Figure 2.4: compute phases over voxels", "voxels", {"ms", "ns/voxel"}, {}};
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const double voxels : {1e4, 1e5, 1e6, 2.5e6, 5e6, 10e6, 20e6, 40e6}) {
    const double scale = std::cbrt(voxels / 40e6);
    const Vec3i dims = (Vec3(1055, 567, 767) * scale).cast<int>();
    const Foam foam(dims, Vec3::Constant(0.064), voxels);
    const OurMesh ours = median_mesh(foam, 1, bin_width_mpa);
    const auto elements = static_cast<double>(ours.elements);
    table.lines.push_back({std::to_string(ours.elements), {ours.sum_ms(), 1e6 * ours.sum_ms() / elements}});
    if (voxels < 1e6) continue;
    const double lx = std::log(elements), ly = std::log(ours.sum_ms());
    n += 1.0, x += lx, y += ly, xx += lx * lx, xy += lx * ly;
  }
  table.print(options.tables, 2);
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  rows.push_back({"femesh", "figure 2.4: slope from 1 to 40 million voxels", slope, 0.0, ""});
  rows.push_back({"femesh", "figure 2.4: slope, away from 1", std::abs(slope - 1.0), 0.0, "", 0.05});
}

/// More elements than fit.
void add_out_of_core(const BenchFolder& folder, std::vector<Row>& rows) {
  const std::filesystem::path volume = folder.path() / "volume.nrrd", inp = folder.path() / "mesh.inp";
  Foam({1000, 1000, 1000}, Vec3::Constant(0.02), 101e6).write_nrrd(volume);
  const auto report =
      run_femesh(volume.string() + " --modulus 0,1 --bins 10 --memory-mb 1024 --out " + inp.string());
  rows.push_back({"femesh", "100 M elements with --memory-mb 1024: elements",
                  report["elements"].get<double>(), 0.0, "", 100e6, Goal::at_least});
  rows.push_back({"femesh", "100 M elements with --memory-mb 1024: peak memory",
                  report["peak_memory_mb"].get<double>(), 0.0, "MB", 1024.0});
  rows.push_back(
      {"femesh", "100 M elements with --memory-mb 1024", report["time_ms"].get<double>() * 1e-3, 0.0, "s"});
}

}  // namespace

std::vector<Row> femesh_suite(const Options& options) {
  std::vector<Row> rows;
  const BenchFolder folder;
  if (options.baselines) add_table_2_1(options, rows);
  TextTable memory{"Tables 2.2 and 2.4: text rows to .inp",
                   "model",
                   {"text MB", "thesis peak MB", "peak MB", "seconds", "write MB/s"},
                   {}};
  for (const ThesisModel& model : thesis_models()) add_model(model, options, folder, memory, rows);
  memory.print(options.tables, 1);
  add_upsampling(options, rows);
  add_figure_2_4(options, rows);
  add_out_of_core(folder, rows);
  return rows;
}

}  // namespace ream::bench
