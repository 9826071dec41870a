#include <algorithm>

#include "bench/bench.hpp"
#include "bench/hostile_crowd.hpp"
#include "bench/machine_rows.hpp"
#include "bench/request_stream.hpp"
#include "bench/served_reaming.hpp"
#include "core/clock.hpp"

namespace ream::bench {
namespace {

constexpr int rest_turns = 6;
constexpr double turn_s = 10.0, requests_per_s = 200.0;
constexpr double rest_misses_goal_points = 0.1, more_memory_goal_mb = 64.0;

/// Means of sessions of one kind; sums of refusals.
struct Loop {
  double missed_percent = 0.0, p99_us = 0.0, peak_memory_mb = 0.0;
  int refusals = 0;

  void add(const ServedTurn& turn) {
    missed_percent += 100.0 * static_cast<double>(turn.loop.missed) * tick_s / turn_s / rest_turns;
    p99_us += turn.loop.tick_us.p99_us / rest_turns;
    peak_memory_mb = std::max(peak_memory_mb, turn.peak_memory_mb);
    refusals += turn.refusals;
  }
};

/// Sums and means of the rest_turns with requests.
struct Asked {
  double asked = 0.0, failed = 0.0, duration_s = 0.0, p50_ms = 0.0, p95_ms = 0.0, p99_ms = 0.0;

  void add(const RequestFigures& one) {
    asked += static_cast<double>(one.asked);
    failed += static_cast<double>(one.failed);
    duration_s += one.duration_s;
    p50_ms += one.p50_ms / rest_turns;
    p95_ms += one.p95_ms / rest_turns;
    p99_ms += one.p99_ms / rest_turns;
  }
};

struct Besieged {
  double connections = 0.0, held = 0.0, attacks = 0.0, sent_mb = 0.0;

  void add(const HostileFigures& one) {
    connections += static_cast<double>(one.connections);
    held = std::max(held, static_cast<double>(one.held));
    attacks += static_cast<double>(one.attacks);
    sent_mb += one.sent_mb;
  }
};

void add_loop_rows(const std::string& beside, const Loop& ours, const Loop& alone, std::vector<Row>& rows) {
  const std::string name = "thesis-5-4-2 served for a minute beside " + beside + " and (baseline) alone, ";
  rows.push_back({"rest", name + "ticks missed", ours.missed_percent, alone.missed_percent, "%",
                  alone.missed_percent + rest_misses_goal_points});
  rows.push_back({"rest", name + "tick p99", ours.p99_us, alone.p99_us, "us"});
  rows.push_back({"rest", name + "memory at the most", ours.peak_memory_mb, alone.peak_memory_mb, "MB",
                  alone.peak_memory_mb + more_memory_goal_mb});
}

void add_request_rows(const Asked& asked, std::vector<Row>& rows) {
  rows.push_back({"rest", "requests answered a second", (asked.asked - asked.failed) / asked.duration_s, 0.0,
                  "1/s", 0.98 * requests_per_s, Goal::at_least});
  rows.push_back({"rest", "requests not answered as expected", asked.failed, 0.0, ""});
  rows.push_back({"rest", "from when a request was due to its answer, p50", asked.p50_ms, 0.0, "ms"});
  rows.push_back({"rest", "from when a request was due to its answer, p95", asked.p95_ms, 0.0, "ms"});
  rows.push_back({"rest", "from when a request was due to its answer, p99", asked.p99_ms, 0.0, "ms"});
}

void add_siege_rows(const Besieged& besieged, int refusals, std::vector<Row>& rows) {
  rows.push_back({"rest", "hostile crowd: connections begun", besieged.connections, 0.0, ""});
  rows.push_back({"rest", "hostile crowd: held at once, at the most", besieged.held, 0.0, ""});
  rows.push_back({"rest", "hostile crowd: bodies, headers and WebSockets", besieged.attacks, 0.0, ""});
  rows.push_back({"rest", "hostile crowd: sent", besieged.sent_mb, 0.0, "MB"});
  rows.push_back({"rest", "hostile crowd: of 60 looks at the session from its address, refused",
                  static_cast<double>(refusals), 0.0, ""});
}

}  // namespace

std::vector<Row> rest_suite(const Options&) {
  StreamViewer viewer;
  RequestStream requests;
  HostileCrowd crowd;
  ServedReaming served(sim::Realtime::attempt, turn_s, Surroundings::office);
  Loop alone, with_requests, with_crowd;
  Asked asked;
  Besieged besieged;
  for (int turn = 0; turn < rest_turns; ++turn) {
    alone.add(served.run(viewer));
    with_requests.add(
        served.run(viewer, [&](const Door& door) { requests.begin(door, requests_per_s, turn_s); }));
    asked.add(requests.end());
    with_crowd.add(served.run(viewer, [&](const Door& door) { crowd.begin(door, turn_s); }));
    besieged.add(crowd.end());
  }
  std::vector<Row> rows;
  add_loop_rows("200 requests a second", with_requests, alone, rows);
  add_request_rows(asked, rows);
  add_loop_rows("a hostile crowd", with_crowd, alone, rows);
  add_siege_rows(besieged, with_crowd.refusals, rows);
  add_machine_rows(rows);
  return rows;
}

}  // namespace ream::bench
