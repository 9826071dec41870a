#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/bench.hpp"
#include "bench/femesh/femesh_suite.hpp"
#include "core/error.hpp"

namespace {

using namespace ream::bench;

const std::map<std::string, std::function<std::vector<Row>(const Options&)>> suites{
    {"case", case_suite},       {"collide", collide_suite},   {"femesh", femesh_suite},
    {"hostile", hostile_suite}, {"loop", loop_suite},         {"python", python_suite},
    {"record", record_suite},   {"rest", rest_suite},         {"score", score_suite},
    {"solve", solve_suite},     {"store", store_suite},       {"surface", surface_suite},
    {"truth", truth_suite},     {"validate", validate_suite}, {"voxelize", voxelize_suite},
    {"web", web_suite}};

bool missed(const Row& row) {
  return row.goal > 0.0 && (row.goal_is == Goal::at_most ? row.ours > row.goal : row.ours < row.goal);
}

/// How many times better than the baseline, or else than the goal; 0 without either.
double ratio(const Row& row) {
  const double other = row.baseline > 0.0 ? row.baseline : row.goal;
  if (!(other > 0.0 && row.ours > 0.0)) return 0.0;
  return row.goal_is == Goal::at_most ? other / row.ours : row.ours / other;
}

void print(const std::vector<Row>& rows, bool json) {
  if (json) {
    nlohmann::json list = nlohmann::json::array();
    for (const Row& r : rows)
      list.push_back({{"suite", r.suite},
                      {"case", r.name},
                      {"ours", r.ours},
                      {"unit", r.unit},
                      {"ratio", ratio(r)},
                      {"baseline", r.baseline > 0.0 ? nlohmann::json(r.baseline) : nlohmann::json()},
                      {"goal", r.goal > 0.0 ? nlohmann::json(r.goal) : nlohmann::json()}});
    std::cout << list.dump() << '\n';
    return;
  }
  for (const Row& r : rows) {
    std::printf("%-8s %-84s %12.4g %-7s", r.suite.c_str(), r.name.c_str(), r.ours, r.unit.c_str());
    if (r.baseline > 0.0) std::printf(" baseline %.4g", r.baseline);
    if (r.goal > 0.0)
      std::printf(" goal%s %.4g%s", r.goal_is == Goal::at_least ? " at least" : "", r.goal,
                  missed(r) ? " MISSED" : "");
    std::printf("\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("ream-bench: measures this build");
  std::string suite;
  Options options;
  bool check = false, json = false;
  app.add_option("suite", suite);
  app.add_flag("--baselines", options.baselines);
  app.add_option("--plots", options.plots);
  app.add_flag("--check", check);
  app.add_flag("--json", json);
  CLI11_PARSE(app, argc, argv);
  if (!suite.empty() && !suites.contains(suite)) {
    std::cerr << "ream-bench: no suite '" << suite << "'\n";
    return 2;
  }
  options.tables = json ? &std::cerr : &std::cout;
  try {
    std::vector<Row> rows;
    for (const auto& [name, run] : suites)
      if (suite.empty() || suite == name)
        for (Row& row : run(options)) rows.push_back(std::move(row));
    print(rows, json);
    bool all_met = true;
    for (const Row& row : rows)
      if (check && missed(row)) {
        std::cerr << "missed: " << row.suite << ' ' << row.name << '\n';
        all_met = false;
      }
    return all_met ? 0 : 1;
  } catch (const ream::Error& e) {
    std::cerr << "ream-bench: " << e.what() << '\n';
    return ream::exit_code(e.kind());
  }
}
