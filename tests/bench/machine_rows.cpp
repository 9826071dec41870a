#include "bench/machine_rows.hpp"

#include <time.h>

#include <algorithm>
#include <thread>

#include "core/clock.hpp"
#include "core/timing_histogram.hpp"
#include "sim/realtime.hpp"

namespace ream::bench {
namespace {

constexpr int seconds = 5;
/// Of every second; a thread that never rests would be held back by the kernel.
constexpr int64_t spun_ns = 900'000'000;
constexpr int64_t second_ns = 1'000'000'000;
/// Two looks at the clock are never this far apart unless somebody else had the processor.
constexpr int64_t gap_ns = 20'000, stall_ns = 1'000'000;

struct Theft {
  double share_percent = 0.0, stalls_a_second = 0.0, longest_ms = 0.0;
};

Theft measure_theft() {
  int64_t lost_ns = 0, longest_ns = 0;
  int stalls = 0;
  for (int i = 0; i < seconds; ++i) {
    int64_t last = steady_ns();
    const int64_t begin = last;
    while (last < begin + spun_ns) {
      const int64_t now = steady_ns();
      if (now - last > gap_ns) lost_ns += now - last;
      if (now - last > stall_ns) ++stalls;
      longest_ns = std::max(longest_ns, now - last);
      last = now;
    }
    std::this_thread::sleep_for(std::chrono::nanoseconds(second_ns - spun_ns));
  }
  const double spun_s = static_cast<double>(seconds) * static_cast<double>(spun_ns) * 1e-9;
  return {100.0 * static_cast<double>(lost_ns) * 1e-9 / spun_s, stalls / spun_s,
          static_cast<double>(longest_ns) * 1e-6};
}

TimingSummary measure_wake_ups() {
  TimingHistogram late;
  int64_t next_ns = steady_ns() + tick_ns;
  for (int i = 0; i < 1000 * seconds; ++i) {
    const timespec until{next_ns / second_ns, next_ns % second_ns};
    while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) != 0) {
    }
    const int64_t now = steady_ns();
    late.add(static_cast<double>(now - next_ns) * 1e-3);
    next_ns = std::max(next_ns, now - now % tick_ns) + tick_ns;
  }
  return late.summary();
}

}  // namespace

void add_machine_rows(std::vector<Row>& rows) {
  Theft theft;
  TimingSummary late;
  bool fifo = false;
  std::thread([&] {
    fifo = sim::ask_for_realtime(sim::Realtime::attempt, -1).fifo;
    theft = measure_theft();
    late = measure_wake_ups();
  }).join();
  const std::string who = fifo ? "a real-time thread, " : "an ordinary thread (real time was refused), ";
  rows.push_back({"loop", who + "time taken by the host", theft.share_percent, 0.0, "%"});
  rows.push_back({"loop", who + "stalls over 1 ms", theft.stalls_a_second, 0.0, "1/s"});
  rows.push_back({"loop", who + "longest stall", theft.longest_ms, 0.0, "ms"});
  rows.push_back({"loop", who + "woken late without spinning, p50", late.p50_us, 0.0, "us"});
  rows.push_back({"loop", who + "woken late without spinning, p99", late.p99_us, 0.0, "us"});
  rows.push_back({"loop", who + "woken late without spinning, p99.9", late.p999_us, 0.0, "us"});
}

}  // namespace ream::bench
