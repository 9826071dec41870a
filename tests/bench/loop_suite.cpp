#include <algorithm>
#include <ostream>

#include "bench/bench.hpp"
#include "bench/empty_loop.hpp"
#include "bench/machine_rows.hpp"
#include "bench/served_reaming.hpp"
#include "core/clock.hpp"

namespace ream::bench {
namespace {

constexpr int turns = 6;
constexpr double turn_s = 10.0;
constexpr double more_misses_goal_points = 0.1, tick_p99_goal_us = 500.0;
constexpr double lateness_p99_goal_us = 10.0, lateness_p999_goal_us = 100.0;

/// Means of all turns; the longest of all.
struct Measured {
  double missed_percent = 0.0;
  TimingSummary tick, lateness, read, step, write;

  void add(const sim::LoopHealth& loop) {
    missed_percent += 100.0 * static_cast<double>(loop.missed) /
                      static_cast<double>(std::max<uint64_t>(ticks_a_turn, 1)) / turns;
    add(loop.tick_us, tick);
    add(loop.lateness_us, lateness);
    add(loop.read_us, read);
    add(loop.step_us, step);
    add(loop.write_us, write);
  }

  static constexpr uint64_t ticks_a_turn = static_cast<uint64_t>(turn_s / tick_s);

 private:
  static void add(const TimingSummary& one, TimingSummary& sum) {
    sum.mean_us += one.mean_us / turns;
    sum.p50_us += one.p50_us / turns;
    sum.p99_us += one.p99_us / turns;
    sum.p999_us += one.p999_us / turns;
    sum.max_us = std::max(sum.max_us, one.max_us);
  }
};

void add_lateness_rows(const Measured& reaming, const Measured& empty, std::vector<Row>& rows) {
  const TimingSummary &ours = reaming.lateness, &base = empty.lateness;
  rows.push_back({"loop", "empty loop, lateness p50", base.p50_us, 0.0, "us"});
  rows.push_back({"loop", "empty loop, lateness p99", base.p99_us, 0.0, "us", lateness_p99_goal_us});
  rows.push_back({"loop", "empty loop, lateness p99.9", base.p999_us, 0.0, "us", lateness_p999_goal_us});
  rows.push_back({"loop", "empty loop, lateness max", base.max_us, 0.0, "us"});
  const std::string name = "served reaming and (baseline) empty loop, lateness ";
  rows.push_back({"loop", name + "p50", ours.p50_us, base.p50_us, "us"});
  rows.push_back({"loop", name + "p99", ours.p99_us, base.p99_us, "us"});
  rows.push_back({"loop", name + "p99.9", ours.p999_us, base.p999_us, "us"});
  rows.push_back({"loop", name + "max", ours.max_us, base.max_us, "us"});
}

void add_stage_rows(const Measured& reaming, std::vector<Row>& rows) {
  const std::string name = "served reaming, ";
  rows.push_back({"loop", name + "tick p50", reaming.tick.p50_us, 0.0, "us"});
  rows.push_back({"loop", name + "tick p99", reaming.tick.p99_us, 0.0, "us", tick_p99_goal_us});
  rows.push_back({"loop", name + "tick p99.9", reaming.tick.p999_us, 0.0, "us"});
  rows.push_back({"loop", name + "tick max", reaming.tick.max_us, 0.0, "us"});
  rows.push_back({"loop", name + "reading the device, p99", reaming.read.p99_us, 0.0, "us"});
  rows.push_back({"loop", name + "step, p99", reaming.step.p99_us, 0.0, "us"});
  rows.push_back({"loop", name + "writing to the device, p99", reaming.write.p99_us, 0.0, "us"});
}

/// Whether the first ticks (cold caches, first touches of memory) are the ones that come late.
void print_seconds(std::ostream& out, const std::vector<uint64_t>& missed_in_second) {
  out << "ticks missed in each second of " << turns << " served sessions:";
  for (const uint64_t missed : missed_in_second) out << ' ' << missed;
  out << '\n';
}

}  // namespace

std::vector<Row> loop_suite(const Options& options) {
  StreamViewer viewer;
  ServedReaming served(sim::Realtime::attempt, turn_s);
  Measured empty, busy, reaming;
  std::vector<uint64_t> missed_in_second;
  double streamed_mb = 0.0;
  for (int turn = 0; turn < turns; ++turn) {
    const ServedTurn one = served.run(viewer);
    const auto loop_beside = [&](double busy_us) {
      return run_empty_loop(turn_s, sim::Realtime::attempt, one.loop.realtime.cpu, busy_us);
    };
    empty.add(loop_beside(0.0));
    busy.add(loop_beside(one.loop.tick_us.mean_us));
    reaming.add(one.loop);
    streamed_mb += one.streamed_mb;
    missed_in_second.resize(std::max(missed_in_second.size(), one.missed_in_second.size()));
    for (size_t i = 0; i < one.missed_in_second.size(); ++i) missed_in_second[i] += one.missed_in_second[i];
  }
  if (options.tables != nullptr) print_seconds(*options.tables, missed_in_second);
  std::vector<Row> rows;
  rows.push_back({"loop", "thesis-5-4-2 served for a minute and (baseline) empty loop, ticks missed",
                  reaming.missed_percent, empty.missed_percent, "%",
                  empty.missed_percent + more_misses_goal_points});
  rows.push_back({"loop", "the same and (baseline) a loop that waits as long in each tick, ticks missed",
                  reaming.missed_percent, busy.missed_percent, "%"});
  add_stage_rows(reaming, rows);
  add_lateness_rows(reaming, empty, rows);
  rows.push_back({"loop", "served reaming, streamed to the viewer a minute",
                  streamed_mb * 60.0 / (turns * turn_s), 0.0, "MB"});
  add_machine_rows(rows);
  return rows;
}

}  // namespace ream::bench
