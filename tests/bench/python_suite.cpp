#include <nlohmann/json.hpp>

#include "bench/bench.hpp"
#include "bench/script_figures.hpp"
#include "core/error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::bench {
namespace {

namespace fs = std::filesystem;

/// What the package is held to.
constexpr double ticks_goal_1_s = 5000.0, call_goal_us = 5.0, memory_goal_mb = 1.0, read_goal_mb_s = 50.0;

nlohmann::json measured(const fs::path& data) {
  const std::string python = REAM_BENCH_PYTHON;
  if (python.empty())
    throw Error(ErrorKind::unavailable, "this build has no package for Python; the preset release makes it");
  const fs::path build = fs::read_symlink("/proc/self/exe").parent_path();
  return script_figures("PYTHONPATH=" + shell_word(build / "python") +
                            " REAM_BIN=" + shell_word(build / "ream") + " REAM_DATA=" + shell_word(data) +
                            " " + shell_word(python) + " " + shell_word(REAM_BENCH_PYTHON_SCRIPT),
                        "the package for Python could not be measured, see above");
}

}  // namespace

std::vector<Row> python_suite(const Options&) {
  const test::TemporaryFolder data;
  const nlohmann::json told = measured(data.path());
  const auto figure = [&](const char* name) { return told.at(name).get<double>(); };
  return {
      {"python", "ticks a second of the whole demo, one core", figure("demo_ticks_1_s"), 0.0, "1/s",
       ticks_goal_1_s, Goal::at_least},
      {"python", "ticks of ten minutes that are not the program's", figure("differing_ticks"), 0.0, "ticks",
       0.5},
      {"python", "ticks that were compared", figure("compared_ticks"), 0.0, "ticks", 599'000.0,
       Goal::at_least},
      {"python", "a call of step(), beside (baseline) a row of run()", figure("step_us"), figure("row_us"),
       "us"},
      {"python", "the difference, which is Python's", figure("step_us") - figure("row_us"), 0.0, "us",
       call_goal_us},
      {"python", "reset()", figure("reset_ms"), 0.0, "ms"},
      {"python", "memory that 10,000 resets leave behind", figure("resets_mb"), 0.0, "MB", memory_goal_mb},
      {"python", "snapshot of the demo's end", figure("snapshot_kb"), 0.0, "kB"},
      {"python", "restore()", figure("restore_ms"), 0.0, "ms"},
      {"python", "reading the ticks of a recording.ream", figure("read_mb_s"), 0.0, "MB/s", read_goal_mb_s,
       Goal::at_least},
  };
}

}  // namespace ream::bench
