#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bench/baselines/zheng.hpp"
#include "bench/collide_parts.hpp"
#include "bench/resolution_study.hpp"
#include "bench/text_table.hpp"
#include "bench/voi_figure.hpp"

namespace ream::bench {
namespace {

constexpr size_t voxmaps = voxmap_resolutions.size(), shells = shell_resolutions.size();

/// Milliseconds on a GTX 970; table 4.3 ends at 512^3.
constexpr double thesis_table_4_1[voxmaps][shells] = {{0.19, 0.20, 0.23, 0.34, 0.76},
                                                      {0.19, 0.21, 0.24, 0.34, 0.79},
                                                      {0.20, 0.21, 0.24, 0.34, 0.79},
                                                      {0.20, 0.21, 0.27, 0.36, 0.81}};
constexpr double thesis_table_4_3[voxmaps - 1][shells] = {
    {0.33, 0.34, 0.40, 0.68, 1.70}, {0.86, 0.89, 1.03, 1.22, 1.86}, {5.20, 5.14, 5.29, 5.52, 6.70}};
constexpr double thesis_table_4_5[voxmaps] = {0.23, 0.50, 2.19, 13.67};
/// Megabytes, at the resolutions of the shells.
constexpr double thesis_shell_mb[shells] = {0.02, 0.07, 0.30, 1.19, 4.75};
constexpr double thesis_voxmap_mb[shells] = {0.26, 2.10, 16.78, 134.22, 1073.74};
constexpr double zheng_shell_mb[shells] = {0.05, 0.22, 0.89, 3.56, 14.26};
constexpr double zheng_voxmap_mb[shells] = {1.31, 10.49, 83.89, 671.09, 5368.71};

std::string cubed(int resolution) { return std::to_string(resolution) + "^3"; }

std::vector<std::string> shell_columns() {
  std::vector<std::string> columns;
  for (const int resolution : shell_resolutions) columns.push_back(cubed(resolution));
  return columns;
}

/// One line over all shells from a function of the shell.
template <class Value>
TextTable::Line line(const std::string& label, Value value) {
  TextTable::Line result{label, {}};
  for (size_t s = 0; s < shells; ++s) result.values.push_back(value(s));
  return result;
}

double milliseconds(double us) { return us / 1000.0; }

/// The lines of one Voxmap in table 4.1 or 4.3: the thesis, its method here, this program, and what the last
/// is faster.
void add_lines(const ResolutionStudy& study, size_t v, const double* thesis_ms,
               const std::vector<std::pair<std::string, Method>>& here, TextTable& table) {
  const std::string name = cubed(voxmap_resolutions[v]) + " ";
  const auto ours_ms = [&](size_t s) { return milliseconds(study.best_of_ours_us(v, s)); };
  const auto best_here_us = [&](size_t s) {
    return std::min(study.time_us(v, s, here[0].second), study.time_us(v, s, here[1].second));
  };
  table.lines.push_back(line(name + "thesis, GTX 970", [&](size_t s) { return thesis_ms[s]; }));
  for (const auto& [label, method] : here)
    table.lines.push_back(line(
        name + label, [&, timed = method](size_t s) { return milliseconds(study.time_us(v, s, timed)); }));
  table.lines.push_back(line(name + "ours, cpu",
                             [&](size_t s) { return milliseconds(study.time_us(v, s, Method::ours_cpu)); }));
  table.lines.push_back(line(name + "ours, OpenCL", [&](size_t s) {
    return milliseconds(study.time_us(v, s, Method::ours_opencl));
  }));
  table.lines.push_back(line(name + "thesis / ours", [&](size_t s) { return thesis_ms[s] / ours_ms(s); }));
  table.lines.push_back(line(name + "its method here / ours",
                             [&](size_t s) { return best_here_us(s) / study.best_of_ours_us(v, s); }));
}

void add_rows(const ResolutionStudy& study, const std::string& table, const std::string& method, size_t v,
              const double* thesis_ms, Method one_thread, Method all_cores, std::vector<Row>& rows) {
  for (size_t s = 0; s < shells; ++s) {
    const std::string name = table + ", Voxmap " + cubed(voxmap_resolutions[v]) + ", PointShell " +
                             cubed(shell_resolutions[s]) + ": ";
    const double ours_us = study.best_of_ours_us(v, s);
    const double here_us = std::min(study.time_us(v, s, one_thread), study.time_us(v, s, all_cores));
    rows.push_back({"collide", name + "best backend", milliseconds(ours_us), thesis_ms[s], "ms", 0.0});
    rows.push_back({"collide", name + method + " here / best backend", here_us / ours_us, 0.0, "times", 0.0});
  }
}

void table_4_1(const ResolutionStudy& study, std::ostream* out, std::vector<Row>& rows) {
  char inside[32];
  std::snprintf(inside, sizeof inside, "%.1f", 100.0 * study.mean_inside);
  TextTable table{"Table 4.1: running time (ms) of contact, mean over 64 seeded poses with 5 to 20 % (mean " +
                      std::string(inside) + " %) of the points inside",
                  "Voxmap          PointShell:",
                  shell_columns(),
                  {}};
  for (size_t v = 0; v < voxmaps; ++v) {
    add_lines(study, v, thesis_table_4_1[v],
              {{"flat kernel here, 1 thread", Method::flat_one_thread},
               {"flat kernel here, all cores", Method::flat_all_cores}},
              table);
    add_rows(study, "table 4.1", "flat kernel", v, thesis_table_4_1[v], Method::flat_one_thread,
             Method::flat_all_cores, rows);
  }
  table.print(out, 3);
}

void table_4_3(const ResolutionStudy& study, std::ostream* out, std::vector<Row>& rows) {
  TextTable table{"Table 4.3: running time (ms) of Zheng et al.'s method, the same poses",
                  "Voxmap          PointShell:",
                  shell_columns(),
                  {}};
  for (size_t v = 0; v + 1 < voxmaps; ++v) {
    add_lines(study, v, thesis_table_4_3[v],
              {{"Zheng here, 1 thread", Method::zheng_one_thread},
               {"Zheng here, all cores", Method::zheng_all_cores},
               {"Zheng here, all cores, flags left", Method::zheng_flags_left}},
              table);
    add_rows(study, "table 4.3", "Zheng et al.", v, thesis_table_4_3[v], Method::zheng_one_thread,
             Method::zheng_all_cores, rows);
  }
  table.print(out, 3);
}

void table_4_4(const ResolutionStudy& study, std::ostream* out, std::vector<Row>& rows) {
  constexpr double mb = 1e6;
  TextTable table{"Table 4.4: memory (MB)", "", shell_columns(), {}};
  table.lines.push_back(line("points here, thousands", [&](size_t s) { return study.points[s] / 1e3; }));
  const auto cells = [](size_t s) { return std::pow(shell_resolutions[s], 3.0); };
  table.lines.push_back(line("PointShell, thesis", [&](size_t s) { return thesis_shell_mb[s]; }));
  table.lines.push_back(line("PointShell, Zheng in the thesis", [&](size_t s) { return zheng_shell_mb[s]; }));
  table.lines.push_back(line("PointShell, flat kernel here",
                             [&](size_t s) { return study.points[s] * sizeof(uint32_t) / mb; }));
  table.lines.push_back(
      line("PointShell, Zheng here", [&](size_t s) { return study.points[s] * Zheng::point_bytes / mb; }));
  table.lines.push_back(line("PointShell, ours", [&](size_t s) { return study.shell_bytes[s] / mb; }));
  table.lines.push_back(line("Voxmap, thesis", [&](size_t s) { return thesis_voxmap_mb[s]; }));
  table.lines.push_back(line("Voxmap, Zheng in the thesis", [&](size_t s) { return zheng_voxmap_mb[s]; }));
  table.lines.push_back(line("Voxmap, flat kernel here", [&](size_t s) { return cells(s) / mb; }));
  table.lines.push_back(line("Voxmap, Zheng here", [&](size_t s) {
    return shell_resolutions[s] > Zheng::largest_resolution ? not_measured
                                                            : cells(s) * Zheng::voxel_bytes / mb;
  }));
  table.lines.push_back(
      line("Voxmap, ours with replica", [&](size_t s) { return study.voxmap_bytes[s] / mb; }));
  table.print(out, 2);
  for (size_t s = 0; s < shells; ++s) {
    const std::string name = "table 4.4, " + cubed(shell_resolutions[s]) + ": ";
    rows.push_back(
        {"collide", name + "PointShell", study.shell_bytes[s] / mb, thesis_shell_mb[s], "MB", 0.0});
    rows.push_back({"collide", name + "Voxmap with replica", study.voxmap_bytes[s] / mb, thesis_voxmap_mb[s],
                    "MB", 0.0});
  }
}

/// Ours with the finest shell, which is the slowest.
void table_4_5(const ResolutionStudy& study, std::ostream* out, std::vector<Row>& rows) {
  TextTable table{
      "Table 4.5: running time (ms) of one thread per voxel (Yau et al.), the same poses; ours with the "
      "1024^3 PointShell",
      "Voxmap",
      {"thesis", "1 thread", "all cores", "ours", "thesis / ours", "here / ours"},
      {}};
  for (size_t v = 0; v < voxmaps; ++v) {
    const double ours_us = study.best_of_ours_us(v, shells - 1);
    const double here_us = std::min(study.yau_one_thread_us[v], study.yau_all_cores_us[v]);
    table.lines.push_back({cubed(voxmap_resolutions[v]),
                           {thesis_table_4_5[v], milliseconds(study.yau_one_thread_us[v]),
                            milliseconds(study.yau_all_cores_us[v]), milliseconds(ours_us),
                            thesis_table_4_5[v] / milliseconds(ours_us), here_us / ours_us}});
    const std::string name = "table 4.5, Voxmap " + cubed(voxmap_resolutions[v]) + ": ";
    rows.push_back({"collide", name + "best backend", milliseconds(ours_us), thesis_table_4_5[v], "ms", 0.0});
    rows.push_back(
        {"collide", name + "Yau et al. here / best backend", here_us / ours_us, 0.0, "times", 0.0});
  }
  table.print(out, 3);
}

}  // namespace

std::vector<Row> thesis_tables(const Options& options) {
  std::vector<Row> rows;
  const ResolutionStudy study = study_resolutions();
  table_4_1(study, options.tables, rows);
  table_4_3(study, options.tables, rows);
  table_4_4(study, options.tables, rows);
  table_4_5(study, options.tables, rows);
  rows.insert(rows.end(), study.rows.begin(), study.rows.end());
  for (Row& row : voi_figure(options)) rows.push_back(std::move(row));
  return rows;
}

}  // namespace ream::bench
